"""The versions of the packages that compute a family."""

from importlib.metadata import PackageNotFoundError, version


def versions() -> tuple[str, ...]:
    """The versions of what computes."""
    found = []
    for package in ("contoursolve", "numpy", "casadi", "python-flint"):
        try:
            found.append(f"{package} {version(package)}")
        except PackageNotFoundError:  # it runs from its source
            found.append(package)
    return tuple(found)
