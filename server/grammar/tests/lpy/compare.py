"""Holds L-Py to the words of cases.txt, which Espalier's own tests are held to.

L-Py comes as a conda package alone (channels openalea3 and conda-forge). Where it is installed:

    python server/grammar/tests/lpy/compare.py
"""

import pathlib
import sys

try:
    from openalea.lpy import Lsystem
except ImportError:
    sys.exit("L-Py is not installed: conda install -c openalea3 -c conda-forge openalea.lpy")


def word(depth, axiom, rules):
    lines = [f"Axiom: {axiom}", f"derivation length: {depth}", "ignore: +-", "production:", *rules, "endlsystem"]
    system = Lsystem()
    system.setCode("\n".join(lines) + "\n")
    return str(system.derive()).replace(" ", "")


def main():
    text = pathlib.Path(__file__).with_name("cases.txt").read_text()
    wrong = 0
    for line in text.splitlines():
        if line.startswith("#"):
            continue
        name, depth, axiom, rules, wanted = (field.strip() for field in line.split("|"))
        found = word(int(depth), axiom, [rule.strip() for rule in rules.split(";;")])
        if found == wanted:
            print(f"{name}: as written down")
        else:
            wrong += 1
            print(f"{name}: {found} is not {wanted}")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
