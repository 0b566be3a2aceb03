"""A window of the workbench without a browser."""


class Page:
    """A window of a page: it keeps the text as the page's own editor does."""

    def __init__(self, desk, window="a"):
        self.desk, self.window, self.text, self.seq, self.program = desk, window, "", 0, ""
        self.view = {}

    def ask(self, do, **fields):
        reply = self.desk.answer({"window": self.window, "do": do, "program": self.program, "seq": self.seq, **fields})
        for each in sorted(reply.get("edits", ()), key=lambda each: -each["from"]):
            self.text = edited(self.text, each)
        self.text = reply.get("text", self.text)
        self.seq = reply.get("seq", self.seq)
        self.program = reply.get("id", self.program)
        while reply.get("examined", 0) < reply.get("lines", 0):
            more = {"window": self.window, "do": "go_on", "program": self.program}
            reply |= self.desk.answer(more)
        self.view |= reply
        return reply

    def type(self, old, new):
        edit = {"from": units(self.text[: self.text.index(old)]), "text": new}
        edit["to"] = edit["from"] + units(old)
        self.text = edited(self.text, edit)
        return self.ask("edit", edits=[edit])


def units(text):
    return len(text.encode("utf-16-le")) // 2


def edited(text, edit):
    wide = text.encode("utf-16-le")
    new = wide[: 2 * edit["from"]] + edit["text"].encode("utf-16-le") + wide[2 * edit["to"] :]
    return new.decode("utf-16-le")
