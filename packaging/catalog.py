#!/usr/bin/env python3
"""Writes the journal's catalog: what docs/operation.md says of each kind of line, under the identifier in config/model/log_kinds.h.
From the repository's root:

    python3 packaging/catalog.py FILE

It exits with 1 where the header's kinds and rules differ, or where the page and the header do not have the same kinds and
levels, each once.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]


def plain(text):
    """Markdown without its marks."""
    return re.sub(r"\[([^]]+)\]\([^)]*\)", r"\1", text).replace("`", "").strip()


def main():
    header = (ROOT / "config/model/log_kinds.h").read_text()
    rules = re.findall(r'\{"([a-z-]+)", "([0-9a-f]{32})",\s*LogLevel::(\w+)', header)
    kinds = re.findall(r"^    (\w+),$", re.search(r"enum class LogKind.*?\{(.*?)\};", header, re.S)[1], re.M)
    if [kind.replace("_", "-") for kind in kinds] != [name for name, *_ in rules]:
        sys.exit("config/model/log_kinds.h: LogKind and log_rules do not have the same kinds in the same order")
    page = (ROOT / "docs/operation.md").read_text()
    rows = re.findall(r"^\| ([a-z-]+) \| (debug|info|warning|error) \| ([^|]*) \| ([^|]*) \| ([^|]*) \|$", page, re.M)
    differ = sorted({(name, level) for name, _, level in rules} ^ {(name, level) for name, level, *_ in rows})
    if differ or len(rows) != len(rules) or not rules:
        sys.exit(f"docs/operation.md and config/model/log_kinds.h do not have the same kinds, each once: {differ}")
    explained = {name: (means, do) for name, _, _, means, do in rows}
    entries = []
    for name, message_id, _ in rules:
        means, do = map(plain, explained[name])
        subject, _, rest = means.partition(". ")
        entries.append(
            f"-- {message_id}\nSubject: {subject.rstrip('.')}\nDefined-By: Starbow\n"
            "Documentation: file:///usr/share/doc/starbow/operation.md\n\n"
            + (rest + "\n" if rest else "") + f"What to do: {do}\n"
        )
    pathlib.Path(sys.argv[1]).write_text("\n".join(entries))


if __name__ == "__main__":
    main()
