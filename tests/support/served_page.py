"""Screens on which the workbench is shown, and what its head says."""

SCREENS = {
    "desktop": {"viewport": {"width": 1300, "height": 900}},
    "desktop, dark": {"viewport": {"width": 1300, "height": 900}, "color_scheme": "dark"},
    "phone": {"viewport": {"width": 390, "height": 844}, "has_touch": True},
    "phone, dark": {"viewport": {"width": 390, "height": 844}, "has_touch": True, "color_scheme": "dark"},
}


def said(page, text) -> None:
    page.locator(".head .said", has_text=text).wait_for()
