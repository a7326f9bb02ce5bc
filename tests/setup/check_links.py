#!/usr/bin/env python3
"""check_links.py FOLDER: every relative link of the Markdown pages under FOLDER leads to a file or folder, and to a
heading, that is there."""

import pathlib
import re
import sys

LINK = re.compile(r"\]\(([^)\s]+)\)")


def slug(heading: str) -> str:
    """A heading's anchor, as GitHub makes it."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
    return re.sub(r"[^\w\- ]", "", text).replace(" ", "-")


def without_code(page: pathlib.Path) -> str:
    return re.sub(r"^```.*?^```", "", page.read_text(), flags=re.DOTALL | re.MULTILINE)


def dead_links(page: pathlib.Path) -> list[str]:
    found = []
    for link in LINK.findall(without_code(page)):
        if re.match(r"[a-z]+:", link):
            continue
        path, _, anchor = link.partition("#")
        target = (page.parent / path) if path else page
        if not target.exists():
            found.append(f"{page}: {link} leads nowhere")
        elif anchor and target.suffix == ".md":
            headings = re.findall(r"^#+ (.*)$", without_code(target), flags=re.MULTILINE)
            if anchor not in {slug(heading) for heading in headings}:
                found.append(f"{page}: {link}: no such heading")
    return found


root = pathlib.Path(sys.argv[1])
pages = [
    page
    for page in sorted(root.rglob("*.md"))
    if not {"build", ".git", "node_modules"} & set(page.relative_to(root).parts)
]
dead = [line for page in pages for line in dead_links(page)]
print("\n".join(dead) or f"{len(pages)} pages, no dead link")
sys.exit(1 if dead or len(pages) < 20 else 0)
