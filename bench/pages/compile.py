#!/usr/bin/env python3
"""Makes the page of every model of the gallery in both languages as LaTeX and as Typst, compiles both, and reports errors and overfull boxes.

    python3 bench/pages/compile.py target/release/strutt [MODEL ...]

What is not installed is left out and said: pdflatex with babel-russian (Debian: texlive-latex-extra, texlive-lang-cyrillic), the compiler of typst or its Python
package (`pip install typst`). The exit code is 1 when a page does not compile or something sticks out.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
LANGUAGES = ("en", "ru")
# a box that is wider than its room by less than this sticks out by nothing that is seen; TeX rounds glue to it
SEEN = 0.1


def run(command, folder):
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, errors="replace", timeout=600)
    return done.returncode, done.stdout + done.stderr


def latex(folder):
    if not shutil.which("pdflatex"):
        return None
    for _ in range(2):
        code, said = run(["pdflatex", "-interaction=nonstopmode", "index.tex"], folder)
    found = [line for line in said.splitlines() if line.startswith("!")]
    if code and not found:
        found = ["pdflatex ended with %d" % code]
    for width in re.finditer(r"Overfull \\[hv]box \(([\d.]+)pt too \w+\)[^\n]*", said):
        if float(width.group(1)) > SEEN:
            found.append(width.group(0))
    return found


def typst(folder):
    if shutil.which("typst"):
        code, said = run(["typst", "compile", "index.typ"], folder)
        return said.splitlines() if code or "warning" in said else []
    try:
        import typst as package
    except ImportError:
        return None
    try:
        package.compile(str(folder / "index.typ"), output=str(folder / "index.pdf"))
    except Exception as error:  # the package has one error for all that goes wrong
        return [str(error)]
    return []


COMPILERS = {"latex": latex, "typst": typst}


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    models = [pathlib.Path(m).resolve() for m in sys.argv[2:]] or sorted((ROOT / "gallery").glob("*/model.toml"))
    bad, missing, pages = 0, set(), 0
    for model in models:
        for language in LANGUAGES:
            for name, compile_ in COMPILERS.items():
                with tempfile.TemporaryDirectory() as folder:
                    folder = pathlib.Path(folder)
                    code, said = run([program, "run", model, "--format", name, "--out", folder, "--lang", language, "--quiet"], folder)
                    found = compile_(folder) if code in (0, 1) else [said]
                    if found is None:
                        missing.add(name)
                        continue
                    pages += 1
                    bad += bool(found)
                    for line in found:
                        print(f"{model.parent.name} {name} {language}: {line}", flush=True)
    print(f"{pages} pages compiled, {bad} with findings" + "".join(f"; no compiler for {name}" for name in sorted(missing)))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
