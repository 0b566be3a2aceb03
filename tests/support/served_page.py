"""Screens on which the workbench is shown, what its head says, and how it shows a fix."""

SCREENS = {
    "desktop": {"viewport": {"width": 1300, "height": 900}},
    "phone": {"viewport": {"width": 390, "height": 844}, "has_touch": True},
    "phone, dark": {"viewport": {"width": 390, "height": 844}, "has_touch": True, "color_scheme": "dark"},
}


def expect(what):
    """What Playwright expects of a part of a page, and waits for."""
    from playwright import sync_api  # noqa: PLC0415 - skipped without it

    return sync_api.expect(what)


def said(page, text) -> None:
    page.locator(".head .said", has_text=text).wait_for()


def shown_fix(fix) -> str:
    """The text of the button of a fix."""
    words, _, outcome = fix["title"].partition(" -> ")
    about = " · ".join(filter(None, (outcome, fix["effect"])))
    return " ".join(filter(None, (fix.get("solution"), words, about)))
