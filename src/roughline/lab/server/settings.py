"""How the server is set up, checked before it starts."""

from __future__ import annotations

from dataclasses import dataclass
from ipaddress import ip_address
from urllib.parse import urlsplit

from roughline.errors import InputError
from roughline.errors.checks import between, refuse

LOCAL_NAMES = ("localhost", "127.0.0.1", "::1")


@dataclass(frozen=True)
class ServerSettings:
    """What the server listens to, and where browsers find it."""

    host: str = "127.0.0.1"  # address to listen to
    port: int = 5107  # 0 takes a free one
    # at which browsers find it through a proxy, such as "https://lab.example.org"; empty without
    address: str = ""

    def __post_init__(self) -> None:
        if not self.host:
            raise InputError("host is empty; give an address, such as 127.0.0.1")
        between("port", self.port, 0, 65535, "0 (any free one) to 65535 is allowed")
        try:
            outside = urlsplit(self.address)
            is_usable = outside.scheme in ("http", "https") and bool(outside.hostname)
            is_usable = is_usable and outside.port != 0 and not outside.query + outside.fragment
        except ValueError:
            is_usable = False
        if self.address and not is_usable:
            needed = "the address of the page in the browser is needed, https://lab.example.org/"
            refuse("address", self.address, needed)

    @property
    def is_local(self) -> bool:
        """Whether it listens to this machine only."""
        try:
            return ip_address(self.host).is_loopback
        except ValueError:
            return self.host == "localhost"
