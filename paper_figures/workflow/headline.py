"""Makes the parts of README that count: how many claims are reproduced, those of the paper apart from those of our
studies, how many accepted files are old, which scenes' claims are refuted, and Table 1 with the CPU beside the GPU.
page_tables.py writes them. The standard library is enough.
"""

import re
import textwrap
from collections import Counter
from functools import lru_cache

from paper_figures.figures import table1_picture as table1
from paper_figures.workflow import contents, verdicts

PLANES = "†"
WIDE = 120  # columns of a document
OLD = re.compile(r"^\d+ of \d+ accepted files .*$", re.M)
SOURCES = "other sources"  # what the sentence about old files links


@lru_cache(maxsize=1)
def judged():
    return verdicts.by_origin(verdicts.judge_all())


def claims(before):
    """Returns the table of verdicts, and sentences about what is refuted and what is old. `before`: the part as it is,
    whose count of old files stays where there is no repository."""
    lines = [f"| claims about results | all | {' | '.join(verdicts.VERDICTS)} |",
             "|---" * (2 + len(verdicts.VERDICTS)) + "|"]
    for name, results in zip(("the paper's own", "our studies'"), judged()):
        found = verdicts.counts(results)
        late = sum(j.late for j in results if j.verdict == "reproduced")
        cells = [f"{found[verdict]} ({late})" if verdict == "reproduced" else str(found[verdict])
                 for verdict in verdicts.VERDICTS]
        lines.append(f"| {name} | {len(results)} | {' | '.join(cells)} |")
    refuted = Counter(j.claim["scene"] for j in judged()[0] if j.verdict == "refuted")
    named = ", ".join(f"`{scene}` {count}" for scene, count in refuted.most_common())
    return "\n".join([*lines, "", textwrap.fill(f"Refuted: {named}.", WIDE), "", old(before)])


def old(before):
    try:
        return contents.in_words().replace(SOURCES, f"[{SOURCES}](paper_figures/README.md#accepted-results)")
    except contents.ContentsError:
        found = OLD.search(before)
        return found[0] if found else ""


def times(before):
    """Returns Table 1 with vertices as the paper and as we count them, and how many means are at most the paper's. On
    the CPU our time is with balls, with planes (PLANES) where only they were run."""
    del before
    lines = ["| scene | vertices | CPU, paper | ours | GPU, paper | balls | planes |", "|---" * 7 + "|"]
    ours = {row["scene"]: int(row["vertices"]) for row in table1.rows_of(table1.MACHINE / "whole_runs.csv")}
    for texts, row in ((texts, row[-1]) for row, (texts, _) in zip(table1.ROWS, table1.table())):
        cpu, balls, planes, *gpu = (text.replace(" / ", "/").replace("not run", "–") for text in texts[8:])
        cells = (f"{texts[1]}/{ours[row]:,}", cpu, planes + PLANES if balls == "–" != planes else balls, *gpu)
        lines.append(f"| `{row}` | {' | '.join(cells)} |")
    on = ", ".join(f"{within(side)} on the {side}" for side in ("GPU", "CPU"))
    return "\n".join([*lines, "", textwrap.fill(f"Means at most the paper's: {on}.", WIDE)])


def within(side):
    """Returns how many of our means on one side are at most the paper's, and which is farthest, in words."""
    backend, ours = {"GPU": ("cuda", table1.on_gpu), "CPU": ("cpu", table1.on_cpu)}[side]
    ratios = {}
    for *_, row in table1.ROWS:
        paper = table1.printed(row, backend)
        for name in (row, f"{row}_planes"):
            if paper and (mean := ours(name).mean):
                ratios[name] = mean / paper.mean
    most = max(ratios, key=ratios.get)
    return f"{sum(ratio <= 1 for ratio in ratios.values())} of {len(ratios)} (most: `{most}`, {ratios[most]:.3g} times)"


PARTS = {"claims": claims, "times": times}
