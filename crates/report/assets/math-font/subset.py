"""Subset of STIX Math for formulas in strutt's pages. Needs: pip install fonttools brotli. Usage: subset.py STIXMath-Regular.otf out.woff2"""
import sys
from fontTools import subset
from fontTools.ttLib import TTFont

ranges = [(0x20, 0x7E), (0x391, 0x3C9), (0x3D1, 0x3D1), (0x410, 0x44F), (0x401, 0x401), (0x451, 0x451),
          (0x1D434, 0x1D467), (0x1D6E2, 0x1D71B), (0x2070, 0x2079), (0x2080, 0x2089)]
single = "ℎ·×±−≤≥≠≈∂√∛∑∫∞°…′″‴⁗˙¨⃛⃜̇̈⃗²³¹\u2009\u00a0\u2061\u2062‖–→"
unicodes = [c for a, b in ranges for c in range(a, b + 1)] + [ord(c) for c in single]
font = TTFont(sys.argv[1])
options = subset.Options(layout_features=["*"], hinting=False, desubroutinize=False, notdef_outline=True, name_IDs=["*"], flavor="woff2")
s = subset.Subsetter(options)
s.populate(unicodes=unicodes)
s.subset(font)
# the licence reserves the original name for unmodified fonts
for record in font["name"].names:
    if record.nameID in (1, 3, 4, 6, 16, 18):
        record.string = "StruttMath" if record.nameID == 6 else "Strutt Math"
if "CFF " in font:
    cff = font["CFF "].cff
    cff.fontNames = ["StruttMath"]
    cff.topDictIndex[0].FullName = cff.topDictIndex[0].FamilyName = "Strutt Math"
font.flavor = "woff2"
font.save(sys.argv[2])
missing = sorted(set(unicodes) - set(font.getBestCmap()))
print(len(font.getGlyphOrder()), "MATH" in font, "missing", [hex(c) for c in missing])
for n in font["name"].names: print(n.nameID, str(n)[:120])
