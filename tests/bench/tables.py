# SPDX-License-Identifier: BSD-3-Clause
"""What parts of the report are made of: figures, targets, and the tables that show both."""
import re
from collections import namedtuple

# metric of the cases that match; how: "<=" or ">="; judged where there are so many cores
Target = namedtuple("Target", "cases metric how limit cores", defaults=(1,))
# What stands in a column: heading, metric with unit, format, and what if there is no such figure.
Column = namedtuple("Column", "heading metric format missing", defaults=("",))


def columns(form, *metrics):
    """Columns of one format, headed by their metrics, with the unit where there is one."""
    def heading(metric):
        name, unit = metric.lstrip(", ").rsplit(":", 1)
        return name if unit == "1" else f"{name} {unit}".strip()
    return [Column(heading(metric), metric, form) for metric in metrics]


class Figures:
    """What the benchmarks of a part told: value by case and 'metric:unit', in their order."""

    def __init__(self, cores):
        self.cases, self.cores = {}, cores

    def get(self, case, metric):
        return self.cases[case].get(metric)

    def all(self, pattern):
        return [case for case in self.cases if re.search(pattern, case)]


# What parts take on two cores, for the estimate of the end.
SECONDS = {
    "store": 36, "look": 12, "draw": 180, "choose": 8, "euler": 43, "kernels": 45, "contacts": 60, "average": 25, "volumes": 4, "sums": 20,
    "lines": 3, "cores": 6, "others": 12, "arrays": 45, "decode": 16, "write": 24, "read": 24, "ranks": 13,
    "scale": 45}


class Part:
    def __init__(self, name, title, about, tables, targets=(), plot=None, needs=None, script=False, wants_cores=1, words=None,
                 page_tables=None):
        self.name, self.title, self.about = name, title, " ".join(about.split())
        self.tables, self.targets, self.plot = tables, targets, plot
        self.needs = needs  # without which a build does not have this part
        self.script = script  # scenes/NAME.py, not the program bench_NAME
        self.words = words  # lines that say what the figures mean, with the figures in them
        self.page_tables = page_tables or tables  # those that users want to see
        self.seconds = SECONDS.get(name, 15)
        self.wants_cores = wants_cores  # fewer make no measurement of it


def cores_missing(part, figures):
    """Lines that refuse times of several threads where the machine did not give as many cores."""
    if part.wants_cores <= figures.cores:
        return []
    return [f"**Times of several threads are no measurement here: the machine gave {figures.given:.1f} cores of {part.wants_cores}.**", ""]


# ---- targets and tables --------------------------------------------------------------------------
def is_met(target, value):
    return value <= target.limit if target.how == "<=" else value >= target.limit


def verdict(part, figures, case, metric, quick):
    """For a cell of the target column; empty where there is none."""
    value = figures.get(case, metric)
    for target in part.targets:
        if target.metric == metric and re.search(target.cases, case) and value is not None:
            wanted = f"{target.how} {target.limit:g}"
            if quick or figures.cores < target.cores:
                return f"{wanted}, not judged"
            return f"met ({wanted})" if is_met(target, value) else f"**not met** ({wanted})"
    return ""


def markdown(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|---" + "|--:" * (len(head) - 1) + "|"]
    return lines + ["| " + " | ".join(row) + " |" for row in rows] + [""]


def cases_by_metrics(cases, *columns):
    """A table: a row a case, a column a metric; the last one says whether targets are met."""
    def make(part, figures, quick):
        rows = []
        for case in figures.all(cases):
            cells, verdicts = [], []
            for column in columns:
                value = figures.get(case, column.metric)
                cells.append(column.missing if value is None else format(value, column.format))
                verdicts.append(verdict(part, figures, case, column.metric, quick))
            rows.append([f"`{case}`"] + cells + ["; ".join(filter(None, verdicts))])
        return markdown(["case"] + [column.heading for column in columns] + ["target"], rows)
    return make


def note(text):
    """A paragraph in the place of a table."""
    return lambda part, figures, quick: [" ".join(text.split()), ""]


def by_numbers(name):
    """A key to sort names by in which 2 comes before 16."""
    return [int(word) if word.isdigit() else word for word in re.split(r"(\d+)", name)]


def contenders_by_metrics(*columns):
    """A table: a row a contender of a case. Its metrics begin with its name; it has that of the first
    column."""
    def make(part, figures, quick):
        rows = []
        for case, told in figures.cases.items():
            own = columns[0].metric
            names = [metric[:-len(own)] for metric in told if metric.endswith(own)]
            for name in sorted(names, key=by_numbers):
                values = [told.get(name + column.metric) for column in columns]
                verdicts = [verdict(part, figures, case, name + column.metric, quick)
                            for column in columns]
                rows.append([f"`{case}`: {name}"] +
                            ["" if value is None else format(value, column.format)
                             for column, value in zip(columns, values)] +
                            ["; ".join(filter(None, verdicts))])
        return markdown(["case"] + [column.heading for column in columns] + ["target"], rows)
    return make


def growth_table(part, figures, quick):
    case = "more and more rows"
    if case not in figures.cases:
        return []
    times = {metric[:-len(":ns/row")]: value for metric, value in figures.cases[case].items()
             if metric.endswith(":ns/row")}
    fastest = min(times.values())
    rows = [[f"`{name}`", format(time, ".1f"), format(time / fastest, ".2f"),
             format(figures.get(case, name + ", page faults a 1000 rows:1"), ".1f"), ""]
            for name, time in sorted(times.items())]
    metric = "slowest against fastest:1"
    ratio = figures.get(case, metric)
    rows.append(["slowest against fastest", "", format(ratio, ".2f"), "",
                 verdict(part, figures, case, metric, quick)])
    return markdown(["12 columns", "ns/row", "against the fastest", "page faults/1000 rows",
                     "target"], rows)


def span(values, form=".1f"):
    """'2.0 to 3.5', or one number if both ends look alike."""
    least, largest = (format(value, form) for value in (min(values), max(values)))
    return least if least == largest else f"{least} to {largest}"


def scientific(value):
    return "0" if value == 0 else f"{value:.1e}".replace("e-0", "e-").replace("e+0", "e+")
