"""Prints the tables of true values: `python run.py [part of a title]`. Versions: requirements.txt. Minutes on one core."""
import sys
import time

import machines

wanted = sys.argv[1] if len(sys.argv) > 1 else ""
for make in machines.ALL:
    began = time.time()
    if wanted and wanted not in f"{make.__name__} {make.__code__.co_consts} {make.__code__.co_names}":
        continue
    table = make()
    print(f"## {table.title}\n", flush=True)
    for note in table.notes:
        print("-", note)
    for number, t in table.events:
        print(f"event {number} at {t:.18g}")
    for name, t, value in table.rows:
        shown = t if isinstance(t, (str, int)) else f"{t:.18g}"
        print(f"{name}({shown}) = {value:.18g}")
    print(f"\n({time.time() - began:.1f} s)\n", file=sys.stderr)
    print(flush=True)
