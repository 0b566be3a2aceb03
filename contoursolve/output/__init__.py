"""What people and programs read: text, JSON, SARIF, DXF, HTML.

Results come in, lines and documents go out. Begin with `listing` for text, `document` for JSON.
"""
