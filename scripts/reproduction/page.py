"""The page: one file that needs no network."""

from __future__ import annotations

import base64
from collections import Counter
from collections.abc import Sequence
from html import escape
from pathlib import Path

from .claims import LAW_WORDS, LAWS, Claim
from .sections import Figure, Section, Table


def page(sections: Sequence[Section], facts: Sequence[str], failures: Sequence[str]) -> str:
    """The whole page as HTML.

    Args:
        facts: lines about how it was made.
        failures: lines about parts that could not be made.
    """
    claims = [claim for section in sections for claim in section.claims]
    parts = [
        "<p>Qian, Qin, Yan, Zhang, <em>Mech. Mach. Theory</em> 145 (2020) 103717, claim by claim. The <strong>law as published</strong> switches each face between surface, "
        "line and point contact; its force jumps there, and the jumps make energy. The <strong>conservative law</strong> has the same contacts in one potential: no switching, "
        "no energy from nowhere. What holds under both is mechanics; what holds under the first alone is made by the law.</p>",
        "<p>The paper shows one orbit per case. Orbits of this mechanism part within milliseconds, so every number here is the mean of an ensemble of starts "
        "with its 95 % interval, and every comparison is one of ensembles: greater means by more than 5 %, beyond chance, in the mean and in the median. "
        "The paper's curves are not in the scan that was at hand; none is copied.</p>",
        *(f'<p class="soft">{escape(fact)}</p>' for fact in facts),
        *(f'<p class="failed">{escape(line)}</p>' for line in failures),
        _contents(sections, claims),
    ]
    parts += [_section(number, section) for number, section in enumerate(sections)]
    return html("Qian et al. (2020), reproduced", "Every table and figure, under both contact laws", parts)


def html(title: str, heading: str, parts: Sequence[str]) -> str:
    """A page that needs no other file."""
    style = (Path(__file__).parent / "style.css").read_text(encoding="utf-8")
    head = '<head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">'
    head += f"\n<title>{escape(title)}</title><style>{style}</style></head>"
    return "\n".join([f'<!DOCTYPE html>\n<html lang="en">{head}<body>\n<h1>{escape(heading)}</h1>', *parts, "</body></html>\n"])


def _contents(sections: Sequence[Section], claims: Sequence[Claim]) -> str:
    rows = []
    for number, section in enumerate(sections):
        counts = Counter((c.verdict.kind, c.verdict.words if c.verdict.kind != "open" else "undecided or not to be told") for c in section.claims)
        verdicts = "<br>".join(f'<span class="verdict {kind}">{count} × {escape(words)}</span>' for (kind, words), count in counts.most_common())
        rows.append(f'<tr><td><a href="#part{number}">{escape(section.title)}</a></td><td>{verdicts or "parameters alone"}</td></tr>')
    return f'<div class="wide"><table><caption>{len(claims)} claims</caption><tbody>{"".join(rows)}</tbody></table></div>'


def _section(number: int, section: Section) -> str:
    parts = [f'<h2 id="part{number}">{escape(section.title)}</h2>', *(f"<p>{escape(words)}</p>" for words in section.words)]
    if section.claims:
        parts.append(_claims(section.claims))
    parts += [_figure(figure) for figure in section.figures]
    parts += [table_html(table) for table in section.tables]
    return "\n".join(parts)


def _claims(claims: Sequence[Claim]) -> str:
    head = "".join(f"<th>{escape(words)}</th>" for words in ("claim", *(LAW_WORDS[law] for law in LAWS), "verdict"))
    rows = []
    for claim in claims:
        cells = [f'<td><span class="place">{escape(claim.place)}</span>{escape(claim.words)}</td>']
        for law in LAWS:
            lines = "".join(f'<span class="line">{escape(line)}</span>' for line in claim.findings[law].lines)
            cells.append(f'<td data-law="{escape(LAW_WORDS[law])}">{lines}</td>')
        cells.append(f'<td data-law="verdict"><span class="verdict {claim.verdict.kind}">{escape(claim.verdict.words)}</span></td>')
        rows.append(f"<tr>{''.join(cells)}</tr>")
    return f'<div class="wide"><table class="claims"><thead><tr>{head}</tr></thead><tbody>{"".join(rows)}</tbody></table></div>'


def _figure(figure: Figure) -> str:
    sides = []
    for law in LAWS:
        image = figure.images[law]
        if isinstance(image, bytes):
            words = escape(f"{figure.caption} {LAW_WORDS[law]}")
            shown = f'<img alt="{words}" src="data:image/png;base64,{base64.b64encode(image).decode()}">'
        else:
            shown = f'<p class="failed">{escape(image)}</p>'
        sides.append(f"<div><h3>{escape(LAW_WORDS[law])}</h3>{shown}</div>")
    return f'<figure><figcaption>{escape(figure.caption)}</figcaption><div class="laws">{"".join(sides)}</div></figure>'


def table_html(table: Table) -> str:
    head = "".join(f"<th>{escape(cell)}</th>" for cell in table.header)
    rows = "".join(f"<tr>{''.join(f'<td>{escape(cell)}</td>' for cell in row)}</tr>" for row in table.rows)
    return f'<div class="wide"><table><caption>{escape(table.caption)}</caption><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table></div>'
