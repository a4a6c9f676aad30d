"""What mkdocs does not do by itself: pages from outside docs/, links to files that are no pages, anchors and lists as on the repository's page."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Any

from mkdocs.structure.files import File, Files

_root = Path(__file__).resolve().parents[2]
# Page of the site, and the file of the repository from which it is made.
_pages = {
    "index.md": "README.md",
    "pages.md": "docs/README.md",
    "benchmarks.md": "bench/results/README.md",
    "contributing.md": "CONTRIBUTING.md",
    "architecture.md": "ARCHITECTURE.md",
    "releasing.md": "RELEASING.md",
    "testing.md": "tests/README.md",
    "python_reference.md": "scripts/site/python_reference.md",
}
_link = re.compile(r"(!?)\[([^\]]*)\]\(([^)\s]+)\)")
_fence = re.compile(r"(\s*```\w*).*")  # a file's name behind the language would not be taken for a fence
_block = re.compile(r"^(\s*```.*?^\s*```)", re.MULTILINE | re.DOTALL)
_item = re.compile(r"\s*([-*]|\d+\.) ")


def anchor(heading: str, separator: str = "-") -> str:
    """A heading's anchor as tests/structure/pages_test.cpp checks it.

    >>> anchor("11. Golden values, `abs`")
    '11-golden-values-abs'
    """
    return "".join(c for c in heading.lower() if c.isalnum() or c in "-_ ").replace(" ", separator)


def on_config(config: Any) -> Any:
    config.mdx_configs.setdefault("toc", {})["slugify"] = anchor
    return config


def on_files(files: Files, config: Any) -> Files:
    for taken in ("README.md", "index.md"):
        if (there := files.get_file_from_path(taken)) is not None:
            files.remove(there)
    for page, source in _pages.items():
        files.append(File.generated(config, page, content=(_root / source).read_text(encoding="utf-8")))
    files.append(File.generated(config, "assets/iframe-worker.js", abs_src_path=str(Path(__file__).with_name("iframe-worker.js"))))
    return files


def on_page_markdown(markdown: str, page: Any, **_: Any) -> str:
    """Links lead to pages of the site; what is no page is named. Lists begin a paragraph."""
    source = page.file.src_uri
    folder = (_root / _pages.get(source, f"docs/{source}")).parent
    lines: list[str] = []
    fenced = False
    for line in markdown.splitlines():
        if line.lstrip().startswith("```"):
            fenced = not fenced
            line = _fence.sub(r"\1", line)
        elif not fenced:
            before = lines[-1] if lines else ""
            begins_list = _item.match(line) and not line.startswith(" ") and not _item.match(before) and not before.startswith(" ")
            begins_table = line.startswith("|") and not before.startswith("|")
            if before and (begins_list or begins_table):
                lines.append("")
        lines.append(line)
    # A link's words may go over lines.
    parts = _block.split("\n".join(lines) + "\n")
    return "".join(part if k % 2 else _outside_code(part, folder, os.path.dirname(source)) for k, part in enumerate(parts))


def _outside_code(prose: str, folder: Path, site_folder: str) -> str:
    """Text whose links are those of the site; spans of code stay."""
    parts = re.split(r"(`[^`\n]*`)", prose)
    # A link's words may be code, so that spans are hidden and put back.
    spans = parts[1::2]
    hidden = "".join(part if k % 2 == 0 else f"\0{k // 2}\0" for k, part in enumerate(parts))
    shown = _link.sub(lambda match: _rewritten(match, folder, site_folder), hidden)
    return re.sub("\0(\\d+)\0", lambda match: spans[int(match[1])], shown)


def _rewritten(match: re.Match[str], folder: Path, site_folder: str) -> str:
    mark, words, target = match.groups()
    if "://" in target or target.startswith("#"):
        return match[0]
    file, _, place = target.partition("#")
    path = os.path.normpath(os.path.relpath(folder / file, _root))
    by_source = {given: made for made, given in _pages.items()}
    if path in by_source:
        to = by_source[path]
    elif path.startswith("docs/"):
        to = path.removeprefix("docs/")
    else:
        return words if path in words else f"{words} (`{path}`)"
    to = os.path.relpath(to, site_folder or ".")
    return f"{mark}[{words}]({to}{'#' + place if place else ''})"
