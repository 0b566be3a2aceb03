"""What an index shows of contoursolve: the addresses of the project, and the README with links that lead there.

Nothing in this folder knows where the project lies. REPOSITORY tells it, as `.github/workflows/publish.yml` does:
`https://HOST/OWNER/NAME`, laid out as on GitHub. A source distribution remembers it. Without it the links stay as they
are, and there are no addresses.
"""

import os
import re
from email.parser import Parser
from pathlib import Path
from typing import Any

from hatchling.metadata.plugin.interface import MetadataHookInterface

PAGES = {
    "Documentation": "docs/index.md",
    "Changelog": "CHANGELOG.md",
    "Test vectors": "docs/vectors.md",
}
"""What an index names beside the repository, and the file that it is."""


class Published(MetadataHookInterface):
    """The fields of the metadata that depend on where the project lies."""

    def update(self, metadata: dict[str, Any]) -> None:
        """Set `readme` and `urls`."""
        root = Path(self.root)
        text, address = (root / "README.md").read_text(encoding="utf-8"), _address(root)
        if address:
            version = f"v{metadata['version']}"
            text = with_addresses(text, address, version)
            pages = {name: f"{address}/blob/{version}/{file}" for name, file in PAGES.items()}
            metadata["urls"] = {"Repository": address, "Issues": f"{address}/issues", **pages}
        else:
            metadata["urls"] = {}
        metadata["readme"] = {"content-type": "text/markdown", "text": text}


def with_addresses(readme: str, address: str, version: str) -> str:
    """The README, whose links lead to the files of a version of the repository, and its pictures to their bytes."""

    def leading(link: re.Match[str]) -> str:
        mark, shown, target = link.groups()
        if "://" in target:
            return link[0]
        place = f"README.md{target}" if target.startswith("#") else target
        return f"{mark}[{shown}]({address}/{'raw' if mark else 'blob'}/{version}/{place})"

    return re.sub(r"(!?)\[([^\]]*)\]\(([^)\s]+)\)", leading, readme)


def _address(root: Path) -> str:
    told, remembered = os.environ.get("REPOSITORY", ""), root / "PKG-INFO"
    if not told and remembered.is_file():
        fields = Parser().parsestr(remembered.read_text(encoding="utf-8")).get_all("Project-URL", [])
        told = next((field.partition(", ")[2] for field in fields if field.startswith("Repository, ")), "")
    return told.rstrip("/")
