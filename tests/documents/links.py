#!/usr/bin/env python3
"""links.py SOURCE_DIRECTORY: links of all pages lead to files and headings that are there, on the forge and in the
site alike; the site has all pages, and the gallery all scenes."""
import re
import sys
from pathlib import Path

top = Path(sys.argv[1]).resolve()
pages = [top / "README.md"] + sorted((top / "doc").rglob("*.md"))
wrong = []


def without_code(text):
    text = re.sub(r"^(```|~~~).*?^\1$", "", text, flags=re.S | re.M)
    return re.sub(r"`[^`\n]*`", lambda match: match[0].replace("[", " ").replace("](", " "), text)


def anchors(page):
    """Names of the headings by the rules of forges; those of Python's markdown must be the same."""
    found = set()
    for heading in re.findall(r"^#+ +(.*?) *#*$", re.sub(r"^```.*?^```$", "", page.read_text(), flags=re.S | re.M), flags=re.M):
        heading = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").lower()
        kept = re.sub(r"[^\w\s-]", "", heading).strip()
        forge, site = kept.replace(" ", "-"), re.sub(r"[-\s]+", "-", kept)
        found.add(forge if forge == site else f"{forge} on the forge and {site} in the site")
    return found


for page in pages:
    for target in re.findall(r"\]\(<?([^)>\s]+)>?(?: \"[^\"]*\")?\)", without_code(page.read_text())):
        if re.match(r"[a-z]+:", target):
            continue
        file, _, anchor = target.partition("#")
        there = (page.parent / file).resolve() if file else page
        if not there.exists() or top not in [there, *there.parents]:
            wrong.append(f"{page.relative_to(top)}: no file {file}")
        elif there.is_dir():
            wrong.append(f"{page.relative_to(top)}: {file} is a directory, which the site cannot show")
        elif anchor and anchor not in anchors(there):
            wrong.append(f"{page.relative_to(top)}: no heading #{anchor} in {there.relative_to(top)}; it has {sorted(anchors(there))}")

site = (top / "doc/mkdocs.yml").read_text()
for page in pages:
    if page.relative_to(top).as_posix() not in re.findall(r"[\w/]+\.md", site):
        wrong.append(f"doc/mkdocs.yml does not name {page.relative_to(top)}")
for name in re.findall(r"[\w/]+\.md", site):
    if not (top / name).exists() and name != "doc/parameters.md":
        wrong.append(f"doc/mkdocs.yml names {name}, which is not there")

gallery = (top / "doc/gallery.md").read_text()
for scene in sorted((top / "prm").glob("*.prm")):
    if f"`prm/{scene.name}`" not in gallery:
        wrong.append(f"doc/gallery.md does not show prm/{scene.name}")
for page in pages:
    for scene in re.findall(r"prm/(\w+\.prm)", page.read_text()):
        if not (top / "prm" / scene).exists():
            wrong.append(f"{page.relative_to(top)} names prm/{scene}, which is not there")

print("\n".join("FAILED  " + line for line in wrong))
sys.exit(bool(wrong))
