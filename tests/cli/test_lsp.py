"""The language server as an editor sees it: over the protocol, from a process of its own."""

import json
import re
from pathlib import Path
from typing import Any

import pytest
from editor import Editor, Served, applied, edits_of, in_editor, types

import contoursolve
from contoursolve import CONTROLS, Severity, solve

PROGRAMS = Path(__file__).parents[2] / "notebooks" / "programs"
BROKEN = (PROGRAMS / "shaft_broken.nc").read_text()
SHAFT = "file:///programs/shaft.nc"


@pytest.fixture(scope="module")
def served():
    """One server for all tests that need no other options."""
    kept = Served({"pictures": True})
    yield kept
    kept.stop()


def at(line: int, character: int) -> types.Position:
    return types.Position(line - 1, character - 1)


def whole(text: str) -> types.Range:
    return types.Range(types.Position(0, 0), types.Position(text.count("\n") + 1, 0))


def stretch(text: str, span: range) -> str:
    return text[offset_of(text, span.start) : offset_of(text, span.end)]


def offset_of(text: str, position: types.Position) -> int:
    return len(applied(text, types.TextEdit(types.Range(position, types.Position(10**6, 0)), "")))


async def actions(editor: Editor, uri: str, where: types.Range, kind: type = types.CodeAction) -> list[Any]:
    """The fixes at a place, or the commands."""
    document, context = types.TextDocumentIdentifier(uri), types.CodeActionContext([])
    found = await editor.ask(
        editor.client.text_document_code_action_async(types.CodeActionParams(document, where, context))
    )
    return [each for each in found if isinstance(each, kind)]


def about(editor: Editor, uri: str, position: types.Position) -> dict[str, object]:
    return {"text_document": types.TextDocumentIdentifier(uri), "position": position}


async def hovered(editor: Editor, uri: str, line: int, character: int) -> str:
    """What is shown beside a place."""
    wanted = types.HoverParams(**about(editor, uri, at(line, character)))
    found = await editor.ask(editor.client.text_document_hover_async(wanted))
    return found.contents.value if found else ""


async def run(editor: Editor, command: str, *arguments: object):
    wanted = types.ExecuteCommandParams(f"contoursolve.{command}", arguments=[*arguments])
    return await editor.ask(editor.client.workspace_execute_command_async(wanted))


# Findings and fixes ------------------------------------------------------------------------------------------


def examples() -> list[pytest.ParameterSet]:
    """A control, and the examples of a few of its rules: each control begins with another one."""
    return [
        pytest.param(
            name, [rule.rejected[0] for rule in control.catalogue[first::24] if rule.rejected], id=f"{name}-{first}"
        )
        for number, (name, control) in enumerate(CONTROLS.items())
        for first in range(number % 12, 24, 12)
    ]


@pytest.fixture(scope="module")
def served_for():
    """From a control to a server for it, which is kept."""
    kept: dict[str, Served] = {}

    def serve(control: str) -> Served:
        if control not in kept:
            kept[control] = Served({"control": control})
        return kept[control]

    yield serve
    for each in kept.values():
        each.stop()


@pytest.mark.slow
@pytest.mark.parametrize(("control", "programs"), examples())
def test_findings_of_the_rules_examples_stand_where_solve_finds_them(served_for, control, programs):
    """And each fix, applied as the editor does it, writes the lines that solve offers."""

    async def use(editor: Editor) -> None:
        for number, text in enumerate(programs):
            uri = f"file:///programs/{number}.nc"
            editor.open(uri, text)
            found, wanted = await editor.findings(uri), solve(text, control=control)
            lines, mended = text.split("\n"), set[str]()
            for each, finding in zip(found, wanted.diagnostics, strict=True):
                assert (each.code, each.range.start.line + 1) == (finding.code, max(finding.span.line, 1))
                assert each.severity.name == SEVERITIES[finding.severity]
                if finding.span.line > 0:
                    marked = lines[finding.span.line - 1][finding.span.column - 1 : finding.span.end_column - 1]
                    assert stretch(text, each.range) == marked
                for fix in finding.fixes:
                    new = {**dict(enumerate(lines, 1)), **fix.by_line(wanted.lines_of(finding))}
                    kept = [line for number, line in new.items() if line or not lines[number - 1]]
                    mended.add("\n".join(kept).rstrip("\n"))
            for action in await actions(editor, uri, whole(text)):
                if action.edit is None:
                    assert action.command.command == "contoursolve.explain"
                elif "Fix all" not in action.title:
                    after = text
                    for edit in reversed(edits_of(action)):
                        after = applied(after, edit)
                    assert after.rstrip("\n") in mended, action.title

    served_for(control)(use)


SEVERITIES = {Severity.ERROR: "Error", Severity.WARNING: "Warning", Severity.INFO: "Information"}


def test_places_count_as_the_protocol_does(served):
    """Tabs, wide characters and surrogate pairs before the word; after edits in their midst, too."""
    head = "G00 X40. Z0.\r\n"
    text = f"{head}(粗加工 😀)\tG111 X100. A180. K-30. B120. P60. (🛠)"

    async def use(editor: Editor) -> None:
        editor.open(SHAFT, text)
        (found,) = await editor.findings(SHAFT)
        assert stretch(text, found.range) == "P60."
        assert (
            found.range.start.character == len(text[len(head) :].split("P60.", maxsplit=1)[0].encode("utf-16-le")) // 2
        )
        smile = text[len(head) :].index("😀")
        editor.edit(SHAFT, types.TextEdit(types.Range(at(2, smile + 1), at(2, smile + 3)), "😀😀"))
        (found,) = await editor.findings(SHAFT)
        assert stretch(editor.texts[SHAFT], found.range) == "P60."

    served(use)


@pytest.mark.slow
def test_a_client_may_count_otherwise():
    async def use(editor: Editor) -> None:
        editor.open(SHAFT, "(粗 😀) G00 X40. Z0.\n(粗 😀) G111 X100. A180. K-30. B120. P60.")
        (found,) = await editor.findings(SHAFT)
        assert found.range.start.character == len("(粗 😀) G111 X100. A180. K-30. B120. ".encode())

    general = types.GeneralClientCapabilities(position_encodings=[types.PositionEncodingKind.Utf8])
    in_editor(use, capabilities=types.ClientCapabilities(general=general))


def test_the_broken_shaft_is_mended_fix_by_fix(served):
    async def use(editor: Editor) -> None:
        editor.open(SHAFT, BROKEN)
        found = await editor.findings(SHAFT)
        assert [each.code for each in found] == [each.code for each in solve(BROKEN).diagnostics]
        large = next(each for each in found if each.code == "g111-corner-too-large")
        assert large.severity is types.DiagnosticSeverity.Error
        assert "alarm 146 (assumed)" in large.message
        reversed_ = next(each for each in found if each.code == "g111-a-ignored")
        assert reversed_.severity is types.DiagnosticSeverity.Warning
        assert any("start point" in each.message for each in reversed_.related_information)
        fix = (await actions(editor, SHAFT, large.range))[0]
        (told,) = await actions(editor, SHAFT, large.range, types.Command)
        assert fix.title.startswith("write P2.5 for P4. -> the contour ends at Z-75.500 mm X66.000 mm, ")
        assert [each.code for each in fix.diagnostics] == ["g111-corner-too-large"]
        editor.edit(SHAFT, *edits_of(fix))
        assert "g111-corner-too-large" not in {each.code for each in await editor.findings(SHAFT)}
        assert "N310 G111 A180. K-20. P2.5 B90. X66. D0.5\n" in editor.texts[SHAFT]
        twice = next(each for each in found if each.code == "g111-x-and-u")
        kept = next(each for each in await actions(editor, SHAFT, twice.range) if each.is_preferred)
        assert kept.title.startswith("delete")
        page = Path(re.sub("^file://", "", large.code_description.href)).read_text()
        assert page.startswith("# g111-corner-too-large")
        assert "2.8.30" in page
        # The client reads an action with a command as that command, and its text holds both.
        assert "'arguments': ['g111-corner-too-large', 'yasnac-lx3']" in told.command
        await run(editor, "explain", "g111-corner-too-large", "yasnac-lx3")
        assert editor.shown == [large.code_description.href]

    served(use)


def test_a_fix_that_drops_a_line_leaves_no_empty_one(served):
    lines = ["1 L X+0 Y+0 R0 F500", "2 FL X+30 AN+0", "3 RND R60", "4 FL X+50 Y+30", "5 L X+60", ""]

    async def use(editor: Editor) -> None:
        editor.open(SHAFT, "\r\n".join(lines))
        (found,) = await editor.findings(SHAFT)
        (fix,) = [each for each in await actions(editor, SHAFT, found.range) if each.title.startswith("delete RND")]
        editor.edit(SHAFT, *edits_of(fix))
        assert editor.texts[SHAFT] == "\r\n".join(lines[:2] + lines[3:])

    served(use)


IGNORED, COOLANT, TOO_LARGE = (
    "G00 X40. Z0.\r\nG111 A135. I10. K-12. B180. Z-40.\r\n",
    "G00 X40. Z0.\nG111 X100. A180. K-30. B120. M08\n",
    "G00 X40. Z0.\rG111 A180. K-30. P90. B120. X100.\n",
)


@pytest.mark.parametrize("later", [True, False])
def test_fix_all_keeps_contours_and_line_ends(later):
    """Of all findings, or of all of one kind; the edit comes when the action is chosen, if the client can wait."""
    text = IGNORED + TOO_LARGE + COOLANT + IGNORED + TOO_LARGE + COOLANT.strip()
    everything = types.Range(types.Position(0, 0), types.Position(10**6, 0))

    async def use(editor: Editor) -> None:
        async def chosen(editor: Editor, only: str | None, title: str) -> types.CodeAction:
            context = types.CodeActionContext([], only=[only] if only else None)
            asked = types.CodeActionParams(types.TextDocumentIdentifier(SHAFT), everything, context)
            found = await editor.ask(editor.client.text_document_code_action_async(asked))
            (action,) = [each for each in found if each.title == title]
            assert (action.edit is None) is later
            return await editor.ask(editor.client.code_action_resolve_async(action)) if later else action

        editor.open(SHAFT, text)
        kinds = [
            ("Fix all 2 g111-a-ignored (same contour)", IGNORED, IGNORED.replace("A135. ", "")),
            ("Fix all 2 g111-corner-too-large (by the first fix of each)", "P90.", "P9."),
        ]
        for title, old, new in kinds:
            action = await chosen(editor, "quickfix", title)
            before = editor.texts[SHAFT]
            editor.edit(SHAFT, *edits_of(action))
            assert editor.texts[SHAFT] == before.replace(old, new)
        editor.edit(SHAFT, types.TextEdit(everything, text))
        for only in ("source.fixAll.contoursolve", "source.fixAll", "source", None):
            action = await chosen(editor, only, "Fix all that keep the contour")
            assert action.kind == "source.fixAll.contoursolve"
        editor.edit(SHAFT, *edits_of(action))
        assert editor.texts[SHAFT] == contoursolve.fix(text).text
        assert {each.code for each in await editor.findings(SHAFT)} == {"g111-corner-too-large"}

    waits = types.ClientCodeActionResolveOptions(["edit"]) if later else None
    client = types.CodeActionClientCapabilities(resolve_support=waits)
    shown = types.WorkspaceEditClientCapabilities(document_changes=True)
    workspace, document = (
        types.WorkspaceClientCapabilities(workspace_edit=shown),
        types.TextDocumentClientCapabilities(code_action=client),
    )
    in_editor(use, capabilities=types.ClientCapabilities(workspace=workspace, text_document=document))


def test_what_is_closed_has_no_findings(served):
    async def use(editor: Editor) -> None:
        editor.open(SHAFT, BROKEN)
        assert await editor.findings(SHAFT)
        editor.client.text_document_did_close(types.DidCloseTextDocumentParams(types.TextDocumentIdentifier(SHAFT)))
        assert await hovered(editor, SHAFT, 13, 8) == ""
        assert editor.found[SHAFT].diagnostics == ()

    served(use)


# What is shown beside the text -------------------------------------------------------------------------------

TURNED = "O0001 (SHAFT)\n(TURN)\n(THE JOURNAL)\nG00 X40. Z0.\nG111 X100. A180. K-30. B120. P5. Q5.\n"


def test_hovers_hints_symbols_folds(served):
    async def use(editor: Editor) -> None:
        client, document = editor.client, types.TextDocumentIdentifier(SHAFT)
        editor.open(SHAFT, TURNED)
        await editor.findings(SHAFT)

        word = await hovered(editor, SHAFT, 5, 20)
        assert word.startswith("**K-30.** Z distance from start to virtual intersection")
        assert "-30 mm" in word
        assert "fixes V1, end of the first straight: Z-30.0000 X40.0000" in word
        contour = await hovered(editor, SHAFT, 5, 2)
        assert "![the contour](data:image/svg+xml;base64," in contour
        assert "| rounding Q5. | G03 | -50.2073 | 100.0000 |" in contour
        assert await hovered(editor, SHAFT, 4, 6) == "**X40.** absolute X of the end point (diameter)"
        assert await hovered(editor, SHAFT, 2, 2) == ""
        (hint,) = await editor.ask(
            client.text_document_inlay_hint_async(types.InlayHintParams(document, whole(TURNED)))
        )
        assert (hint.position, hint.label) == (at(5, 37), "ends at Z-50.2073 X100.0000")
        (symbol,) = await editor.ask(client.text_document_document_symbol_async(types.DocumentSymbolParams(document)))
        assert (symbol.name, symbol.detail) == ("G111, program line 5", "solved, ends at Z-50.2073 X100.0000")
        folds = await editor.ask(client.text_document_folding_range_async(types.FoldingRangeParams(document)))
        assert [(each.start_line, each.end_line, each.kind) for each in folds] == [(1, 2, "comment")]
        lenses = await editor.ask(client.text_document_code_lens_async(types.CodeLensParams(document)))
        assert [each.command.title for each in lenses] == ["draw", "explore", "expand"]
        for lens in lenses:
            await run(editor, lens.command.command.partition(".")[2], *lens.command.arguments)
        draw, explore, expand = (Path(re.sub("^file://", "", uri)).read_text() for uri in editor.shown)
        assert draw.startswith("<svg")
        source = json.loads(explore)["cells"][0]["source"]
        assert "'G00 Z0 X40.\\nG111 X100. A180. K-30. B120. P5. Q5.', control='yasnac-lx3'" in source
        assert "G03 X100. Z-50.207 I-2.5 K-4.33\n" in expand

    served(use)


def test_a_hover_does_not_wait_for_the_end_of_a_long_program(served):
    """A line that is not examined yet says what the word means, and how far the examination is."""
    one = "G00 X40. Z0.\nG111 X100. A180. K-30. B120. P5. Q5.\nG01 Z-60.\n"

    async def use(editor: Editor) -> None:
        editor.open(SHAFT, one * 10_000)
        late = await hovered(editor, SHAFT, 29_999, 20)
        assert late.startswith("**K-30.** Z distance from start to virtual intersection")
        assert re.search(r"not known yet: \d+ of 30001 lines are examined\.$", late)
        # What is in sight is examined before all others.
        near = types.InlayHintParams(types.TextDocumentIdentifier(SHAFT), types.Range(at(3_001, 1), at(3_002, 1)))
        (hint,) = await editor.ask(editor.client.text_document_inlay_hint_async(near))
        assert hint.label == "ends at Z-50.2073 X100.0000"
        assert SHAFT not in editor.statuses
        assert "fixes V1, end of the first straight: Z-30.0000 X40.0000" in await hovered(editor, SHAFT, 3_002, 20)
        wanted = {"textDocument": {"uri": SHAFT}, "position": {"line": 19_999, "character": 8}}
        assert await editor.ask(editor.client.protocol.send_request_async("contoursolve/picture", wanted))
        assert SHAFT not in editor.statuses

    served(use)


def explored(notebook: str) -> tuple[str, dict[str, Any]]:
    """The program and the options that a notebook asks for."""
    code = json.loads(notebook)["cells"][0]["source"]
    text, told = re.search(r"explore\(('.*?'), (.*)\)", code, re.DOTALL).groups()
    return eval(text), eval(f"dict({told})")


INCREMENTAL = "G20 G17 G90 G0 X1. Y1.\nG91\nG01 X4. ,R.5\nG01 Y5.\n"


def test_a_notebook_explores_the_contour_with_the_modal_codes_before_it(served):
    async def use(editor: Editor) -> None:
        editor.open(SHAFT, f"(contoursolve control: fanuc-mill)\n{INCREMENTAL}")
        found = await run(editor, "explore", SHAFT, 3)
        text, options = explored(found["notebook"])
        (answer,) = solve(text, **options).answers
        (wanted,) = solve(INCREMENTAL, control="fanuc-mill").answers
        assert answer.end_text == wanted.end_text == "X5.00000 Y6.00000"

    served(use)


def test_no_word_is_offered_within_a_number(served):
    async def use(editor: Editor) -> None:
        editor.open(SHAFT, "G00 X40. Z0.\nG111 A135. K-10. B120. X100\n")
        assert not await completed(editor, 2, 28)

    served(use)


@pytest.mark.parametrize(
    ("first", "table", "told"),
    [
        (
            "(contoursolve tool: R6, tip 3)",
            "",
            "nose R6, tip 3, right of the contour: it does not fit; a nose up to R5 cuts all",
        ),
        (
            "T0101",
            "T0101 = {radius = 0.8, tip = 3}",
            "nose R0.8, tip 3, right of the contour: it fits; a nose up to R5 cuts all",
        ),
        ("(contoursolve tool: R0.8)", "", "a turning tool needs the number of its imaginary tip"),
        ("T0202", "T0101 = {radius = 0.8, tip = 3}", ""),
    ],
)
def test_a_hover_says_which_tool_fits_and_the_picture_shows_it(served, tmp_path, first, table, told):
    (tmp_path / "contoursolve.toml").write_text(f"[tools]\n{table}\n")
    uri = (tmp_path / "a.nc").as_uri()

    async def use(editor: Editor) -> None:
        editor.open(uri, f"{first}\nG00 G42 X40. Z0.\nG111 X100. A180. K-30. B120. P5. Q5.\nG00 G40 X120.\n")
        await editor.findings(uri)
        word, contour = [await hovered(editor, uri, 3, column) for column in (20, 2)]
        assert (f"Tool: {told}" in word) is (f"Tool: {told}" in contour) is bool(told)
        assert ("Tool: " in word) is bool(told)
        params = {"textDocument": {"uri": uri}, "position": {"line": 2, "character": 1}}
        picture = await editor.ask(editor.client.protocol.send_request_async("contoursolve/picture", params))
        drawn = {"R6": "arc too small: 1 mm", "R0": "path of the tip"}.get(told[5:7] if told[:4] == "nose" else "", "")
        assert drawn in picture.svg
        assert ("tip 3" in picture.svg) is bool(drawn)

    served(use)


def test_a_broken_project_file_is_a_finding(served, tmp_path):
    (tmp_path / "contoursolve.toml").write_text('control = "fanuc-mil"\n')
    uri = (tmp_path / "a.nc").as_uri()

    async def use(editor: Editor) -> None:
        editor.open(uri, TURNED)
        (found,) = await editor.findings(uri)
        assert "there is no control 'fanuc-mil'" in found.message
        assert not await actions(editor, uri, found.range, types.Command)

    served(use)


@pytest.mark.slow
def test_hints_lenses_and_pictures_can_be_switched_off():
    async def use(editor: Editor) -> None:
        document = types.TextDocumentIdentifier(SHAFT)
        editor.open(SHAFT, TURNED)
        client = editor.client
        assert not await editor.ask(
            client.text_document_inlay_hint_async(types.InlayHintParams(document, whole(TURNED)))
        )
        assert not await editor.ask(client.text_document_code_lens_async(types.CodeLensParams(document)))
        await editor.findings(SHAFT)
        hover = await hovered(editor, SHAFT, 5, 2)
        assert "| rounding Q5. | G03 | -50.2073 | 100.0000 |" in hover
        assert "data:image" not in hover

    in_editor(use, {"inlayHints": False, "codeLenses": False, "pictures": False})


async def completed(editor: Editor, line: int, character: int) -> dict[str, types.CompletionItem]:
    found = await editor.ask(
        editor.client.text_document_completion_async(
            types.CompletionParams(**about(editor, SHAFT, at(line, character)))
        )
    )
    return {each.label: each for each in found.items}


def test_completions_are_the_words_that_the_block_may_still_take(served):
    async def use(editor: Editor) -> None:
        editor.open(SHAFT, "G00 X40. Z0.\nG111 A135. K-10. B120. \n")
        found = await completed(editor, 2, 24)
        assert {"U?", "X?", "Z?", "P?"} <= found.keys()
        assert "A?" not in found
        assert "I?" not in found  # K and A have said it
        assert found["P?"].detail == "radius of the first rounding"
        editor.edit(SHAFT, types.TextEdit(types.Range(at(2, 24), at(2, 24)), found["U?"].text_edit.new_text))
        assert editor.texts[SHAFT].endswith("B120. U${1}\n")
        editor.edit(SHAFT, types.TextEdit(types.Range(at(2, 24), at(2, 30)), "U40. "))
        found = await completed(editor, 2, 29)
        assert {"P?", "Q?", "C?", "D?"} == found.keys()
        help_ = await editor.ask(
            editor.client.text_document_signature_help_async(
                types.SignatureHelpParams(**about(editor, SHAFT, at(2, 29)))
            )
        )
        assert [each.label for each in help_.signatures] == ["A135. K-10. B120. U40. P Q C D"]

    served(use)


@pytest.mark.parametrize("control", CONTROLS)
def test_an_empty_line_offers_the_legal_forms_of_the_control(served, control):
    """Each of them is a block that the control accepts."""

    async def use(editor: Editor) -> None:
        editor.open(SHAFT, f"(contoursolve control: {control})\n\n")
        found = await completed(editor, 2, 1)
        assert {each.detail for each in found.values()} <= {form.title for form in CONTROLS[control].forms}
        for each in found.values():
            text = re.sub(r"\$\{\d+:([^}]*)\}", r"\1", each.text_edit.new_text)
            assert each.label == text.replace("\n", " / ")

    served(use)


# The control -------------------------------------------------------------------------------------------------

AMBIGUOUS = "G00 X40. Y0\nG02 X60. Y20. R30. ,R2.\nG01 Y60.\n"


@pytest.mark.slow
def test_the_control_comes_from_a_comment_the_project_the_editor_or_the_program(tmp_path):
    (tmp_path / "project").mkdir()
    (tmp_path / "project" / "contoursolve.toml").write_text('control = "haas-lathe"\n')
    uris = [(tmp_path / name).as_uri() for name in ("a.nc", "project/b.nc", "project/c.nc")]

    async def use(editor: Editor) -> None:
        editor.open(uris[0], AMBIGUOUS)
        editor.open(uris[1], AMBIGUOUS)
        editor.open(uris[2], f"(contoursolve control: nct-99m)\n{AMBIGUOUS}")
        await editor.until(lambda: all(uri in editor.statuses for uri in uris))
        told = [(editor.statuses[uri].control, editor.statuses[uri].source) for uri in uris]
        assert told == [("fanuc-lathe", "editor setting"), ("haas-lathe", "project file"), ("nct-99m", "comment")]
        editor.section = {}
        editor.client.workspace_did_change_configuration(types.DidChangeConfigurationParams(None))
        editor.open("file:///programs/g111.nc", TURNED)
        await editor.until(lambda: editor.statuses[uris[0]].source == "none")
        await editor.until(lambda: editor.statuses["file:///programs/g111.nc"].source == "program")
        (found,) = await editor.findings(uris[0])
        assert found.code == "control-unknown"
        assert "editor's settings" in found.message
        (tmp_path / "project" / "contoursolve.toml").write_text('control = "nothing"\n')
        change = types.FileEvent(uris[1], types.FileChangeType.Changed)
        editor.client.workspace_did_change_watched_files(types.DidChangeWatchedFilesParams([change]))
        await run(editor, "controls")
        await hovered(editor, uris[1], 1, 1)
        assert "there is no control 'nothing'" in editor.statuses[uris[1]].message

    in_editor(use, {"control": "fanuc-lathe"})


# Commands ----------------------------------------------------------------------------------------------------


def test_commands_of_a_client(served):
    async def use(editor: Editor) -> None:
        text = (PROGRAMS / "shaft.nc").read_text()
        editor.open(SHAFT, text)
        expanded = await run(editor, "expand", SHAFT)
        assert expanded["text"] == contoursolve.expand(text).text
        converted = await run(editor, "convert", SHAFT, "fanuc-lathe")
        assert converted["text"] == contoursolve.convert(text, "fanuc-lathe").text
        page = await run(editor, "report", SHAFT)
        assert page["html"].startswith("<!doctype html>")
        controls = await run(editor, "controls")
        assert [each["name"] for each in controls] == [*CONTROLS]
        line = next(answer.lines[0] for answer in solve(text).answers)
        params = {"textDocument": {"uri": SHAFT}, "position": {"line": line - 1, "character": 8}}
        picture = await editor.ask(editor.client.protocol.send_request_async("contoursolve/picture", params))
        keys = {word.key for word in picture.words}
        assert keys == set(re.findall(r'data-word="([^"]+)"', picture.svg))
        for word in picture.words:
            span = types.Range(
                types.Position(word.range.start.line, word.range.start.character),
                types.Position(word.range.end.line, word.range.end.character),
            )
            assert stretch(text, span) == word.text
        refused = await run(editor, "expand", "file:///nowhere.nc")
        assert refused["text"] is None
        assert refused["message"]

    served(use)


# Endurance ---------------------------------------------------------------------------------------------------


HOSTILE = {
    "nothing": "",
    "one long line": "G111 " + "X1." * 100_000,
    "brackets": "G01 X[" + "[" * 50_000,
    "comments": "(" * 100_000,
    "control characters": "\0\x01\x02\x1a\x7f\ufeff\ud800".replace("\ud800", "\ufffd") * 1_000,
    "line ends": "\r\n\r\r\n\n\x0b\x0c\x1c\x85\u2028" * 2_000 + "G111 X100. A180.",
    "a chain": "G17 G0 X0 Y0\n" + "G1 X1 ,A30\nG1 ,A60\n" * 60,
    "facts": "G111 X100. (contoursolve: " + "line 1 = 5; " * 2_000 + ")",
}


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_programs_do_not_end_the_server(served, name):
    async def use(editor: Editor) -> None:
        text = HOSTILE[name]
        editor.open(SHAFT, text)
        await editor.findings(SHAFT)
        last = text.count("\n")
        editor.edit(SHAFT, types.TextEdit(types.Range(types.Position(last, 0), types.Position(last, 5)), "G00 X40."))
        await editor.findings(SHAFT)
        document = types.TextDocumentIdentifier(SHAFT)
        await editor.ask(editor.client.text_document_folding_range_async(types.FoldingRangeParams(document)))
        await completed(editor, last + 1, 3)
        editor.open("file:///programs/good.nc", TURNED)
        assert not await editor.findings("file:///programs/good.nc")
        assert not editor.messages

    served(use)


@pytest.mark.slow
def test_a_program_with_findings_everywhere_does_not_flood_the_editor(served_for):
    async def use(editor: Editor) -> None:
        editor.open(SHAFT, "G00 X40. Z0.\nG111 X40.5.5\n" * 510)
        found = await editor.findings(SHAFT)
        assert len(found) == 501
        assert (found[-1].code, found[-1].range.start.line) == ("more-findings", 1001)
        assert found[-1].message.startswith("10 more findings")

    served_for("yasnac-lx3")(use)
