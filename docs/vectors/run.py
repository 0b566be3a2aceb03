"""Run the test vectors of this folder against a program: `python run.py COMMAND [ARGUMENT ...]`.

The program reads one question a line from standard input, and prints one answer a line; docs/vectors.md says which.
"""

import json
import subprocess
import sys
from pathlib import Path


def question(control: str, vector: dict) -> dict:
    """What the program is asked: a line of its input."""
    return {"control": control, "settings": vector.get("settings", {}), "program": "\n".join(vector["program"])}


def difference(vector: dict, answer: dict) -> str:
    """How an answer differs from a vector; empty if it is right."""
    if refused := vector.get("refused"):
        if "refused" not in answer:
            return f"a path, but line {refused['line']} is to be refused: {refused['code']}"
        is_right = answer.get("alarm") in (None, *refused["alarms"])
        return "" if is_right else f"alarm {answer['alarm']}, not {' or '.join(refused['alarms'])}"
    moves, begin = answer.get("path"), 0
    if moves is None:
        return f"refused: {answer.get('refused')}"
    for contour in vector["contours"]:
        sizes = [2 if vector.get("x") == "diameter" and axis == "X" else 1 for axis in contour["axes"]]
        meant = contour["path"]
        for at in range(begin, len(moves) - len(meant) + 1):
            if all(is_same(*pair, sizes, vector["tolerance"]) for pair in zip(meant, moves[at:], strict=False)):
                begin = at + len(meant)
                break
        else:
            return f"lines {contour['lines']}: no {len(meant)} moves in a row are those of the vector"
    return ""


def is_same(meant: dict, move: dict, sizes: list[int], tolerance: float) -> bool:
    """Whether a line or an arc is the one that is meant, by all numbers that both have."""
    gaps = [abs(move[name] - meant[name]) for name in {"radius"} & meant.keys() & move.keys()]
    for name in {"center"} & meant.keys() & move.keys() | {"end"}:
        gaps += [abs(has * size - at) for has, size, at in zip(move[name], sizes, meant[name], strict=True)]
    return move.get("turn") == meant.get("turn") and max(gaps) <= tolerance


def main(command: list[str]) -> bool:
    """Ask the program about every vector, and print what is wrong; whether anything is."""
    files = [json.loads(path.read_text("utf-8")) for path in sorted(Path(__file__).parent.glob("*.json"))]
    asked = [(file["control"], vector) for file in files for vector in file.get("vectors", ())]
    lines = "".join(json.dumps(question(*each)) + "\n" for each in asked)
    told = subprocess.run(command, input=lines, stdout=subprocess.PIPE, check=True, encoding="utf-8").stdout
    found = [difference(each, json.loads(line)) for (_, each), line in zip(asked, told.splitlines(), strict=True)]
    wrong = [f"{control}, {each['id']}: {how}" for (control, each), how in zip(asked, found, strict=True) if how]
    print(*wrong, f"{len(asked) - len(wrong)} of {len(asked)} answers are right", sep="\n")
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
