"""Hooks of mkdocs for the documentation's site (mkdocs.yml).

They add the pages of other folders, the sources that pages link to and the generated reference, and change links from
the repository's layout to the site's."""

import os
import pathlib
import posixpath
import re
import subprocess
import sys
import tempfile

from mkdocs.structure.files import File

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import reference

ROOT = pathlib.Path(__file__).resolve().parents[2]
# A Markdown link or image: its text's end and its target.
LINK = re.compile(r"(?<=\]\()([^)\s]+)(?=\))")
# Pages of the repository that have another place on the site.
PLACES = {"README.md": "index.md", "docs/README.md": "pages.md"}


def site_path(path: str) -> str:
    """Where a file of the repository is on the site, both as paths from the roots."""
    if path in PLACES:
        return PLACES[path]
    if path.startswith("docs/"):
        return path.removeprefix("docs/")
    return path if path.endswith(".md") else f"source/{path}.md"


def links_of(text: str) -> list[str]:
    """The relative links of a Markdown text, outside of its code blocks."""
    text = re.sub(r"^```.*?^```", "", text, flags=re.DOTALL | re.MULTILINE)
    return [link for link in LINK.findall(text) if not re.match(r"[a-z]+:|#|/", link)]


def target_of(page: str, link: str) -> str:
    """The file or folder of the repository that a link of `page` leads to."""
    return posixpath.normpath(posixpath.join(posixpath.dirname(page), link.partition("#")[0]))


def source_page(path: str) -> str:
    """A source file as a page; of a folder the names in it."""
    file = ROOT / path
    if file.is_dir():
        listed = subprocess.run(["git", "ls-files", path], cwd=ROOT, capture_output=True, text=True, check=True).stdout
        names = "\n".join(f"- `{name}`" for name in listed.splitlines())
        return f"# {path}\n\n{names}\n"
    language = {"hpp": "cpp", "h": "c", "yaml": "yaml"}.get(path.rsplit(".", 1)[-1], path.rsplit(".", 1)[-1])
    return f"# {path}\n\n````{language}\n{file.read_text()}\n````\n"


def collected_pages() -> dict[str, str]:
    """All pages, by their path in the repository, beginning at README.md and docs/ and following links."""
    pages: dict[str, str] = {}
    waiting = ["README.md", *(f"docs/{file.name}" for file in sorted((ROOT / "docs").glob("*.md")))]
    while waiting:
        path = waiting.pop()
        if path in pages:
            continue
        if not path.endswith(".md"):
            pages[path] = source_page(path)
            continue
        pages[path] = (ROOT / path).read_text()
        for target in (target_of(path, link) for link in links_of(pages[path])):
            if not (ROOT / target).exists():
                raise SystemExit(f"{path}: a link to {target}, which does not exist")
            if (ROOT / target / "README.md").is_file():
                target += "/README.md"
            if not re.search(r"\.(png|svg|gif|webp|jpg)$", target):
                waiting.append(target)
    return pages


def relinked(page: str, text: str) -> str:
    """The text of a page with its links pointed at the site's files."""

    def pointed(match: re.Match[str]) -> str:
        link = match.group(1)
        if re.match(r"[a-z]+:|#|/", link):
            return link
        target = target_of(page, link)
        if (ROOT / target / "README.md").is_file():
            target += "/README.md"
        image = re.search(r"\.(png|svg|gif|webp|jpg)$", target)
        place = target.removeprefix("docs/") if image else site_path(target)
        anchor = "#" + link.partition("#")[2] if "#" in link else ""
        return posixpath.relpath(place, posixpath.dirname(site_path(page)) or ".") + anchor

    parts = re.split(r"(^```.*?^```$)", text, flags=re.DOTALL | re.MULTILINE)
    return "".join(part if part.startswith("```") else LINK.sub(pointed, part) for part in parts)


def board(program: str) -> bytes:
    """The page of all committed results of the suites' split `public`."""
    folders = sorted(str(folder) for folder in (ROOT / "results/suites").glob("*/*/public/*"))
    with tempfile.TemporaryDirectory() as folder:
        page = pathlib.Path(folder, "board.html")
        subprocess.run([program, "suite", "board", *folders, "--page", page], stdout=subprocess.DEVNULL, check=True)
        return page.read_bytes()


def on_files(files, config):
    for path, text in collected_pages().items():
        place = site_path(path)
        if (there := files.get_file_from_path(place)) is not None:
            files.remove(there)
        content = relinked(path, text) if path.endswith(".md") else text
        files.append(File.generated(config, place, content=content))
    if (readme := files.get_file_from_path("README.md")) is not None:
        files.remove(readme)
    css = (ROOT / "scripts/site/site.css").read_text()
    files.append(File.generated(config, "site.css", content=css))
    program = os.environ.get("AVOIDBENCH_PROGRAM", str(ROOT / "build/release/avoidbench"))
    for place, content in reference.pages(program, ROOT).items():
        files.append(File.generated(config, place, content=content))
    files.append(File.generated(config, "board.html", content=board(program)))
    return files
