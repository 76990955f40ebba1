"""Campaigns: hundreds of bodies on one machine or many, stored as soon as they are computed.

>>> from roughline import campaign
>>> plan = campaign.read_plan("plan.toml")
>>> campaign.run(plan, "plan.zarr")
>>> data = campaign.Store("plan.zarr").dataset("lines")
"""

from roughline.campaign.plan import Ensemble, Plan
from roughline.campaign.plan_file import plan_from, read_plan
from roughline.campaign.run import Summary, run
from roughline.campaign.store import Store

__all__ = ["Ensemble", "Plan", "Store", "Summary", "plan_from", "read_plan", "run"]
