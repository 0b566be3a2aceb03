"""A copy of Pyodide's distribution on this machine, with stand-ins for the packages that cannot be had here."""

import hashlib
import json
import shutil
import site
from collections.abc import Iterable
from pathlib import Path
from zipfile import ZipFile

STAND_INS = Path(__file__).parent / "stand_ins" / "browser"


def _installed(package: str) -> Path:
    """Where a package of this Python lies."""
    return next(path for folder in site.getsitepackages() if (path := Path(folder) / package).is_dir())


def make_distribution(core: Path, folder: Path) -> Path:
    """The files of npm's package `pyodide`, and beside them the packages that the page asks for.

    numpy and casadi are those of `stand_ins`. The others are copies of the pure Python that is installed here.
    """
    shutil.copytree(core, folder)
    sources = {
        "numpy": STAND_INS / "numpy",
        "casadi": STAND_INS / "casadi.py",
        **{name: _installed(name) for name in ("markupsafe", "sympy", "mpmath")},
    }
    depends = {"casadi": ["numpy"], "sympy": ["mpmath"]}
    lock = json.loads((folder / "pyodide-lock.json").read_text(encoding="utf-8"))
    lock["packages"] = {
        name: {
            "name": name,
            "version": lock["packages"][name]["version"],
            "file_name": f"{name}.zip",
            "install_dir": "site",
            "sha256": _pack(source, folder / f"{name}.zip"),
            "package_type": "package",
            "imports": [name],
            "depends": depends.get(name, []),
            "unvendored_tests": False,
        }
        for name, source in sources.items()
    }
    (folder / "pyodide-lock.json").write_text(json.dumps(lock), encoding="utf-8")
    return folder


def _pack(source: Path, archive: Path) -> str:
    """Python files as an archive; its checksum."""
    files: Iterable[Path] = [source] if source.is_file() else sorted(source.rglob("*.py"))
    with ZipFile(archive, "w") as written:
        for path in files:
            if "tests" not in path.parts[len(source.parts) :]:
                written.write(path, path.relative_to(source.parent))
    return hashlib.sha256(archive.read_bytes()).hexdigest()
