"""What is asked of rough bodies: checked before any file is read."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Literal, TypeVar, get_args

from roughline.assessment.asked import (
    Adhesion,
    Asked,
    Closure,
    FlowAlong,
    Fluid,
    Friction,
    History,
    Inlet,
    Joint,
    Outlet,
    Seal,
    Theories,
    Ultrasound,
    Unloading,
    WholeCurve,
    with_earlier_keywords,
)
from roughline.assessment.given import (
    Parsed,
    as_si,
    bodies_or_paths,
    body_or_path,
    pair_of,
    quantity,
    refuse_unless_one_modulus,
    several,
)
from roughline.assessment.kinds import WITHOUT_YIELD, has_spectrum, nominal_area
from roughline.assessment.reading import Reading
from roughline.contact.arguments import given_half_space
from roughline.contact.elastic_pair import ElasticPair
from roughline.contact.strain import BEYOND, LARGEST_STRAIN
from roughline.engineering.attraction import Attraction
from roughline.engineering.coated import Coated, Solid
from roughline.engineering.pair import MaterialPair, contact_modulus
from roughline.engineering.sealing import ATMOSPHERE, Sealing
from roughline.errors import InputError
from roughline.errors.checks import number, refuse, shown, whole
from roughline.errors.public import public
from roughline.errors.words import called
from roughline.topography.body import Body, Line, Surface, sides_of
from roughline.topography.preparation import Preparation
from roughline.units import decimal, engineering, load_in_newtons

DEFAULT_LOADS = 20

UNLOADING = (0.75, 0.5, 0.25, 0.1, 0.0)
"""Loads over the largest one, on the way back to none."""

_Kind = TypeVar("_Kind")
_Value = TypeVar("_Value")


def _checked(asked: Any) -> tuple[Asked, ...]:
    """Return what is asked, each of a kind of its own."""
    found = several(asked)
    for each in found:
        if not isinstance(each, get_args(Asked)):
            refuse(
                "ask", each, 'give what is asked, such as rl.Friction(0.3) or rl.Joint("2 cm^2")'
            )
    kinds = [type(each).__name__ for each in found]
    for kind in kinds:
        if kinds.count(kind) > 1:
            raise InputError(f"holds several rl.{kind}; give one", "ask")
    return found


def _periodic(given: Any) -> bool | Literal["x", "y"]:
    """Return along which axes a body is repeated, as those that are pressed are."""
    return given_half_space(None, 1.0, given).periodic


def _hardness(given: Any) -> float:
    """Return a hardness; without end, it stands for no yield. [Pa]"""
    hardness = as_si(given, "Pa", "hardness")
    if not hardness > 0:
        elastic = called("elastic", True)
        refuse("hardness", given, f"a positive pressure is needed, or {elastic} for no yield")
    return hardness


@with_earlier_keywords
@public
@dataclass(frozen=True)
class Question:
    """What is asked of one rough body against a smooth or a rough one.

    Everything is in SI units; a quantity is a number, or a text with its unit.

    Parameters
    ----------
    body : Surface, Line, str or Path, or iterable of them
        What is pressed: a body in metres, or a file with a topography. A line scan (a Line of kind
        "profile") goes through its spectrum to the reduced model. Several are maps of one part,
        each from another place; they are pressed one by one, under the same loads.
    materials : pair of Material, Coated or str, or str, optional
        Of both bodies: materials or their descriptions, ("steel", "gold 0.5 um on copper"), or one
        text with a comma between, "steel,gold 0.5 um on copper".
    E_star : float or str, optional
        Contact modulus instead of materials; the result is then the curve without answers. [Pa]
    loads : float or str, or sequence of them, optional
        Total forces [N], or texts: forces, "10 N", or mean pressures over the nominal area,
        "2 MPa". Forces act on the body, or on the :class:`roughline.Joint`
        that is asked for.
    depths : float or str, or sequence of them, optional
        Depths since first touch instead of loads. [m]
    hardness : float or str, optional
        Hardness of the softer body, taken as exact; default: that of the materials, with its
        scatter, where it is known. Points that reach it yield and are indented permanently. [Pa]
    elastic : bool, optional
        Whether both bodies are elastic, whatever their hardness.
    n_loads : int, optional
        Number of forces from first touch to saturation; 20 if no loads and no depths are given.
    ask : what is asked beside the contact, or sequence of it, optional
        Any of :class:`roughline.Friction`, :class:`roughline.Ultrasound`, :class:`roughline.Joint`,
        :class:`roughline.Theories`, :class:`roughline.History`, :class:`roughline.Unloading` and
        :class:`roughline.WholeCurve`.
    against : Surface, Line, str or Path, optional
        Topography of the second body, read and prepared like the first; without it, it is smooth.
    periodic : bool, "x" or "y", optional
        As for :func:`roughline.press`; along one direction alone only with `E_star`.
    grid_error : bool, optional
        Whether the grid's error is estimated; default: where that is cheap, and with a
        whole curve, on 64 points a side or more. Without it no interval is given.
    reading : Reading, optional
        How files are read.
    preparation : Preparation, optional
        Of each topography; default: the tilt of measured ones is removed.
    fields : bool, optional
        Whether the fields of one load are kept: of the largest, or, with `n_loads`, of the load at
        three quarters of their number.

    Raises
    ------
    InputError
        If the question does not fit together.
    UnitError
        If a text has no unit, or a wrong one.

    Examples
    --------
    >>> import roughline as rl
    >>> spectrum = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6, q_roll=2.5e4)
    >>> surface = spectrum.surface(64, rng=7)  # in metres
    >>> question = rl.Question(surface, E_star="100 GPa", loads=["1 MPa", "2 MPa"])
    >>> print(rl.assess(question).curve.stiffness.round(-5))
    [ 6900000. 10900000.]

    >>> pair, asked = ("steel", "copper"), [rl.Friction(0.3), rl.Ultrasound("5 MHz")]
    >>> question = rl.Question(surface, pair, loads="10 N", ask=asked)
    """

    body: Parsed[Body | Path | tuple[Body | Path, ...]] = Parsed(bodies_or_paths)
    materials: Parsed[tuple[Solid, Solid] | None] = Parsed(pair_of, default=None)
    E_star: Parsed[float | None] = Parsed(
        quantity("Pa", "E_star", "a positive, finite contact modulus is needed"), default=None
    )
    loads: Parsed[tuple[float | str, ...]] = Parsed(several, default=())
    depths: Parsed[tuple[float | str, ...]] = Parsed(several, default=())
    n_loads: int | None = None
    ask: Parsed[tuple[Asked, ...]] = Parsed(_checked, default=())
    against: Parsed[Body | Path | None] = Parsed(
        functools.partial(body_or_path, name="against"), default=None
    )
    periodic: Parsed[bool | Literal["x", "y"]] = Parsed(_periodic, default=False)
    hardness: Parsed[float | None] = Parsed(_hardness, default=None)
    elastic: bool = False
    grid_error: bool | None = None
    reading: Reading = field(default_factory=Reading)
    preparation: Preparation | None = None
    fields: bool = True

    def __post_init__(self) -> None:
        if self.hardness is not None and self.elastic:
            raise InputError(
                f"{called('hardness')} and {called('elastic', True)} contradict each other; give "
                "one of them",
                None,
                *("hardness", "elastic"),
            )
        if self.reading != Reading() and not any(
            isinstance(each, Path) for each in (*self.bodies, self.against)
        ):
            raise InputError(
                f"{called('reading')} says how files are read, but no file is given: leave it out"
            )
        if self.n_loads is None and not self.loads and not self.depths:
            object.__setattr__(self, "n_loads", DEFAULT_LOADS)
        self._check_strip()
        self._check_joint()
        self._check_loads()
        self._check_materials()
        self._check_layers()
        self._check_sealing()
        self._check_adhesion()
        if self.is_of_several:
            self._check_maps()
        for body in (*self.bodies, self.against):
            if isinstance(body, Surface | Line):
                self.refuse_misfit(body)

    def _asked(self, kind: type[_Kind], of: Callable[[_Kind], _Value]) -> _Value | None:
        """A value of what is asked of a kind, if it is."""
        return next((of(each) for each in self.ask if isinstance(each, kind)), None)

    @property
    def attraction(self) -> Attraction | None:
        """How the bodies attract each other; None if they only push."""
        return self._asked(Adhesion, lambda asked: asked.attraction)

    @property
    def friction(self) -> float | None:
        """Coefficient of friction that partial slip is asked for. [1]"""
        return self._asked(Friction, lambda asked: asked.coefficient)

    @property
    def frequency_in_hertz(self) -> float | None:
        """Frequency that a reflection is asked for. [Hz]"""
        return self._asked(Ultrasound, lambda asked: asked.frequency)

    @property
    def sealing(self) -> Sealing | None:
        """What is asked of a fluid in the gap; None if there is none."""
        fluid = self._asked(Fluid, lambda asked: asked.fluid)
        if fluid is None:
            return None
        outlet = self._asked(Outlet, lambda asked: asked.pressure)
        inlet = self._asked(Inlet, lambda asked: asked)
        return Sealing(
            fluid,
            None if inlet is None else inlet.pressure,
            ATMOSPHERE if outlet is None else outlet,
            self._asked(Seal, lambda asked: asked.shape),
            self.flow_along,
            None if inlet is None else inlet.carries,
        )

    @property
    def whole_of_gap(self) -> tuple[float | None, Literal["joint", "seal"]]:
        """Nominal area of what the gap belongs to [m²], the seal or else the joint, and which."""
        seal = self._asked(Seal, lambda asked: asked.shape)
        return (self.joint, "joint") if seal is None else (seal.area, "seal")

    @property
    def flow_along(self) -> Literal["x", "y", "both"]:
        """Direction over the map in which a fluid flows."""
        return self._asked(FlowAlong, lambda asked: asked.direction) or "both"

    @property
    def finds_closing(self) -> bool:
        """Whether the pressure that seals is asked for."""
        return self._asked(Closure, bool) is not None

    @property
    def joint(self) -> float | None:
        """Nominal area of the joint; None if loads act on the body. [m²]"""
        return self._asked(Joint, lambda asked: asked.area)

    @property
    def theories(self) -> tuple[str, ...]:
        """Names of the theories that are asked."""
        return self._asked(Theories, lambda asked: asked.names) or ()

    @property
    def history(self) -> bool:
        """Whether loads or depths follow each other as they are given."""
        return self._asked(History, bool) is not None

    @property
    def unload(self) -> bool:
        """Whether the largest load is taken off again."""
        return self._asked(Unloading, bool) is not None

    @property
    def whole_curve(self) -> bool:
        """Whether further loads are solved too."""
        return self._asked(WholeCurve, bool) is not None

    @property
    def is_of_several(self) -> bool:
        """Whether it is asked of a list of maps of one part, be it a single one."""
        return isinstance(self.body, tuple)

    @property
    def bodies(self) -> tuple[Body | Path, ...]:
        """The body, or all maps of the part."""
        return self.body if isinstance(self.body, tuple) else (self.body,)

    def of_each(self) -> list[Question]:
        """The same question of each body alone."""
        return [replace(self, body=body) for body in self.bodies]

    @property
    def pair(self) -> MaterialPair | None:
        """Both materials, with the hardness that is given; None without materials."""
        if self.materials is None:
            return None
        pair = MaterialPair(*self.materials)
        if self.hardness is None or self.hardness == math.inf:
            return pair
        return pair.with_hardness(self.hardness)

    @property
    def elasticity(self) -> ElasticPair:
        """How both bodies give way to pressure: by a modulus that is given, or by the materials."""
        pair = self.pair
        return ElasticPair(self.E_star or math.nan) if pair is None else pair.elasticity

    @property
    def modulus(self) -> float:
        """Contact modulus, given or of what lies at both surfaces. [Pa]"""
        return self.elasticity.E_star

    @property
    def coated(self) -> list[Coated]:
        """The bodies that are coated."""
        return [] if self.pair is None else self.pair.coated

    @property
    def name(self) -> str:
        """What the first body is called: its file's name, or what it is."""
        if self.is_of_several:
            count = len(self.bodies)
            return f"{count} maps" if count > 1 else "a single map"
        if isinstance(self.body, Path):
            return self.reading.name or self.body.name
        return "a surface" if isinstance(self.body, Surface) else "a line"

    @property
    def headings(self) -> list[str]:
        """What each load or depth is called, in its order: as it was typed, or with its unit."""
        named = [(each, "N") for each in self.loads]
        named += [(each, "m") for each in self.depths]
        headings = [
            each if isinstance(each, str) else engineering(each, unit) for each, unit in named
        ]
        falling = UNLOADING if self.unload else ()
        return headings + [f"unloaded to {each:.0%}" if each else "unloaded" for each in falling]

    @property
    def repeated_along(self) -> bool | Literal["x", "y"]:
        """Along which axes what is pressed is repeated: as asked, or all, as a joint goes on."""
        return self.periodic if self.joint is None else True

    @property
    def is_repeated(self) -> bool:
        """Whether what is pressed is repeated along both axes."""
        return self.repeated_along is True

    def scale(self, area: float) -> float:
        """How many times larger the joint is than a body of a nominal area [m²]; 1 without one."""
        return 1.0 if self.joint is None else self.joint / area

    def forces(self, area: float) -> list[float]:
        """Total forces on a body of a nominal area, in the order of the loads. [N]

        Of a joint the body carries as much as its share of the area.
        """
        scale = self.scale(area)
        forces = [
            load_in_newtons(load, area * scale)
            if isinstance(load, str)
            else number("loads", load, 'a force in N, or a text such as "2 MPa", is needed')
            for load in self.loads
        ]
        for i, (load, force) in enumerate(zip(self.loads, forces, strict=True)):
            if not (0 < force < math.inf or (force == 0 and self.history and i)):
                to_unload = ", and zero only to unload after others" if self.history else ""
                refuse("loads", load, f"give positive ones{to_unload}")
        if self.unload:
            forces += [share * max(forces) for share in UNLOADING]
        return [force / scale for force in forces]

    def heights(self) -> list[float]:
        """Depths, in their order. [m]"""
        return [as_si(depth, "m", "depths") for depth in self.depths]

    def strains(self, body: Body) -> list[tuple[float, str]]:
        """Return how far each load strains a body: as a ratio, and in words."""
        area = nominal_area(body)
        side = min(sides_of(body))
        if depths := self.heights():
            what = "depth {} is {} times the shorter side of the body"
            ratios = [depth / side for depth in depths]
        else:
            elasticity = self.elasticity
            what = "the mean pressure of load {} is {} times the contact modulus"
            if elasticity.is_layered:
                what = "the mean pressure of load {} strains the layers or their base by about {}"
            side = math.inf if self.is_repeated else side
            ratios = [elasticity.strain(force / area, side) for force in self.forces(area)]
        return [
            (ratio, what.format(heading, decimal(ratio, 2)))
            for heading, ratio in zip(self.headings, ratios, strict=False)
        ]

    def refuse_misfit(self, body: Body) -> None:
        """Refuse what does not suit the kind of a body, or its size."""
        if isinstance(body, Line):
            self._refuse_of_line(body)
        elif self.joint is not None and body.area > self.joint * (1 + 1e-9):  # sides are rounded
            raise InputError(
                f"the joint has an area of {engineering(self.joint, 'm²')}, less than the map, "
                f"which has {engineering(body.area, 'm²')}: crop the map, or leave "
                f"{called('rl.Joint')} out"
            )
        else:
            self._refuse_far_attraction(min(body.sizes))
        for ratio, text in self.strains(body):
            if ratio > LARGEST_STRAIN:
                raise InputError(f"{text}, and {BEYOND}: give a smaller one, and check its unit")
        if self.theories and not has_spectrum(body):
            raise InputError(
                "theories are evaluated for a rough surface of 8 x 8 points or more, whose pixels "
                "are nearly square"
            )

    def _refuse_far_attraction(self, side: float) -> None:
        """Refuse bodies that pull each other farther, or more, than a body of a side [m] stands."""
        if self.attraction is None:
            return
        reach, work = self.attraction.range or 0.0, self.attraction.work
        adhesion, of_side = called("rl.Adhesion"), f"the shorter side, {engineering(side, 'm')}"
        if reach > side:
            text = f"the range of {adhesion}, {engineering(reach, 'm')}, is longer than {of_side}"
        elif work > self.modulus * side:
            text = (
                f"the work of {adhesion}, {engineering(work, 'J')}/m², is more than the contact "
                f"modulus times {of_side}"
            )
        else:
            return
        raise InputError(f"{text}: give a smaller one, and check its unit", None, "adhesion")

    def refuse_thin_layers(self, surface: Surface) -> None:
        """Refuse layers that the grid of a surface does not resolve."""
        for each in self.coated:
            try:
                each.elasticity.half_space.refuse(surface.spacing)
            except InputError:
                top, thickness = each.layers[0]
                cell = engineering(max(surface.spacing), "m")
                raise InputError(
                    f"have a layer of {top.name}, {engineering(thickness, 'm')}, thinner than half "
                    f"a cell of {cell}: leave it out, as what lies below is felt alone on such a "
                    "grid, or press on a finer one",
                    "materials",
                ) from None

    def _refuse_of_line(self, line: Line) -> None:
        """Refuse what belongs to a surface."""
        for each in self.coated:
            raise InputError(
                f"{shown(each.name)} is coated, and the springs of a line have one modulus: give a "
                "body of one material, or press a map",
                "materials",
            )
        if line.kind == "profile" and (self.periodic or self.grid_error or self.depths):
            raise InputError(
                "periodic, grid_error and depths belong to a surface; a line scan is pressed by "
                "loads, through its spectrum: leave them out, or press a map"
            )
        given = {
            called("hardness"): self.hardness is not None,
            called("rl.History"): self.history,
            called("rl.Unloading"): self.unload,
        }
        if any(given.values()):
            came = " and ".join(name for name, is_given in given.items() if is_given)
            raise InputError(
                "hardness, history and unload belong to a surface; the reduced model of a line "
                f"{WITHOUT_YIELD} (rms slopes below 0.8 H / E*): leave {came} out, or press a map"
            )
        if self.attraction is not None:
            raise InputError(
                f"{called('rl.Adhesion')} belongs to a surface: springs of a line stick as bodies "
                "of revolution do, which touch in one disc, and a rough line in many; leave it "
                "out, or press a map"
            )
        if self.sealing is not None or self.finds_closing:
            asked = called("rl.Closure" if self.sealing is None else "rl.Fluid")
            raise InputError(
                f"{asked} belongs to a surface: along a line, in one dimension, any contact stops "
                "the flow; leave it out, or press a map"
            )
        if self.joint is not None:
            joint = called("rl.Joint")
            raise InputError(
                f"{joint} belongs to a surface: a line stands for the square of its length alone, "
                f"and what lies beyond is not known; leave {joint} out"
            )

    def _check_strip(self) -> None:
        """Refuse answers of a body that is repeated along one side alone, all of them at once."""
        if not isinstance(self.periodic, str):
            return
        asked = {
            **{"Friction": self.friction, "Ultrasound": self.frequency_in_hertz},
            **{"Joint": self.joint, "Fluid": self.sealing, "Closure": self.finds_closing or None},
        }
        names = [called(f"rl.{name}") for name, value in asked.items() if value is not None]
        if self.materials is None and not names:
            return
        materials, take = called("materials"), []
        if self.materials is not None:
            take.append(f"give a contact modulus ({called('E_star')}) in place of {materials}")
        if names:
            take.append(f"leave {' and '.join(names)} out")
        raise InputError(
            "answers are known of bodies that are free or repeated both ways, not of one that is "
            f"repeated along {self.periodic} alone; for its curve, {' and '.join(take)}",
            None,
            *("periodic", "materials"),
        )

    def _check_joint(self) -> None:
        """Refuse a joint that is asked for what only a body has."""
        if self.joint is None:
            return
        joint, materials = called("rl.Joint"), called("materials")
        if self.materials is None:
            text = f"answers of a joint ({joint}) need two materials ({materials})"
            raise InputError(text, None, "joint_area")
        if self.depths:
            raise InputError(
                f"a joint ({joint}) is pressed by loads ({called('loads')}): its depth counts from "
                "the touch of its highest point, which a map does not show"
            )

    def _check_loads(self) -> None:
        """Refuse loads, depths and numbers of loads that do not go together."""
        loads, depths = called("loads"), called("depths")
        given = (self.n_loads, self.loads or None, self.depths or None)
        if sum(each is not None for each in given) > 1:
            raise InputError(f"give one of {loads}, {depths} and {called('n_loads')}")
        if self.n_loads is not None:
            whole("n_loads", self.n_loads, 2, "a whole number of at least 2 is needed")
        if self.unload and (not self.loads or self.history):
            raise InputError(
                f"{called('rl.Unloading')} takes off the largest of the loads ({loads}); in a "
                "history, and for depths, write the falling values yourself"
            )
        if self.history and not (self.loads or self.depths):
            raise InputError(
                f"{called('rl.History')} needs {loads} or {depths} in the order of the history"
            )
        self.forces(1.0)  # reads and checks them; a pressure waits for its area
        self.heights()

    def _check_materials(self) -> None:
        """Refuse two rigid bodies, and answers that need materials without them."""
        materials = called("materials")
        if self.materials is not None:
            contact_modulus(*(each.surface for each in self.materials))
        elif self.friction is not None or self.frequency_in_hertz is not None:
            text = f"reflection and partial slip need two materials ({materials})"
            which = "frequency" if self.friction is None else "friction"
            raise InputError(text, None, which)
        refuse_unless_one_modulus(self.E_star, self.materials)

    def _check_layers(self) -> None:
        """Refuse partial slip of coated bodies."""
        if self.coated and self.friction is not None:
            raise InputError(
                f"partial slip ({called('rl.Friction')}) follows from the ratio of tangential and "
                f"normal stiffness of bodies of one material each, and {self.coated[0].name} is "
                f"coated: leave {called('rl.Friction')} out",
                None,
                *("friction", "materials"),
            )

    def _check_sealing(self) -> None:
        """Refuse what belongs to a fluid without one, and pressures that drive none."""
        sealing = self.sealing
        if self.materials is None and (sealing is not None or self.finds_closing):
            asked = called("rl.Closure" if sealing is None else "rl.Fluid")
            text = f"{asked} needs two materials ({called('materials')})"
            raise InputError(text, None, "sealing_pressure" if sealing is None else "fluid")
        for each, name in ((Inlet, "inlet"), (Outlet, "outlet"), (Seal, "seal")):
            if sealing is None and self._asked(each, bool):
                text = f"{called(f'rl.{each.__name__}')} belongs to a fluid ({called('rl.Fluid')})"
                raise InputError(f"{text}: give that too", None, name, "fluid")
        if sealing is None:
            return
        inlet, seal = called("rl.Inlet"), called("rl.Seal")
        if (sealing.inlet is None) != (sealing.seal is None):
            have, need = (inlet, seal) if sealing.seal is None else (seal, inlet)
            raise InputError(f"a leak needs {need} beside {have}: give it", None, "inlet", "seal")
        if sealing.inlet is not None and not sealing.inlet > sealing.outlet:
            outside = engineering(sealing.outlet, "Pa")
            raise InputError(
                f"the inlet ({inlet}) is at {engineering(sealing.inlet, 'Pa')}, and the outlet "
                f"({called('rl.Outlet')}) at {outside}, both absolute: a fluid enters where its "
                "pressure is higher",
                None,
                *("inlet", "outlet"),
            )

    def _check_adhesion(self) -> None:
        """Refuse what is not known of bodies that stick."""
        if self.attraction is None:
            return
        adhesion, pair = called("rl.Adhesion"), self.pair
        hardness = pair.hardness if self.hardness is None and pair is not None else self.hardness
        if hardness is not None and hardness < math.inf and not self.elastic:
            raise InputError(
                f"bodies that stick ({adhesion}) and also yield are not solved: take them as "
                f"elastic ({called('elastic', True)}), or leave {adhesion} out",
                None,
                *("adhesion", "elastic"),
            )
        if self.friction is not None:
            raise InputError(
                f"partial slip ({called('rl.Friction')}) of bodies that stick ({adhesion}) is not "
                "known: leave one of them out",
                None,
                *("adhesion", "friction"),
            )
        if self.finds_closing:
            raise InputError(
                f"{called('rl.Closure')} bisects loads, and bodies that stick ({adhesion}) depend "
                "on those before: leave one of them out",
                None,
                *("adhesion", "sealing_pressure"),
            )

    def _check_maps(self) -> None:
        """Refuse several maps without what they are compared by."""
        if self.materials is None:
            raise InputError(
                "several maps are compared by their answers, which need two materials "
                f"({called('materials')})"
            )
        if not self.loads and not self.depths:
            raise InputError(
                f"several maps are pressed under the same loads: give them ({called('loads')})"
            )
        if self.against is not None:
            against = called("against")
            raise InputError(
                f"several maps are pressed into a smooth body: the one second topography "
                f"({against}) would be the same for all maps, and its own scatter between places "
                f"would not show; press each map against it alone, or leave {against} out"
            )
        if self.reading.name is not None:
            raise InputError(
                f"the name in {called('reading')} is that of one file, and there are several maps: "
                "leave it out"
            )
