"""Screens on which the workbench is shown, what its head says, and how it shows a fix."""

SCREENS = {
    "desktop": {"viewport": {"width": 1300, "height": 900}},
    "desktop, dark": {"viewport": {"width": 1300, "height": 900}, "color_scheme": "dark"},
    "phone": {"viewport": {"width": 390, "height": 844}, "has_touch": True},
    "phone, dark": {"viewport": {"width": 390, "height": 844}, "has_touch": True, "color_scheme": "dark"},
}


def said(page, text) -> None:
    page.locator(".head .said", has_text=text).wait_for()


def shown_fix(fix) -> str:
    """The text of the button of a fix."""
    words, _, outcome = fix["title"].partition(" -> ")
    about = " · ".join(filter(None, (outcome, fix["effect"])))
    return " ".join(filter(None, (fix.get("solution"), words, about)))
