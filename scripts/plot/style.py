"""The figures' style: for print, one column wide, distinguishable without colours."""

import matplotlib
import matplotlib.pyplot as pyplot

COLUMN_IN, PAGE_IN = 3.5, 7.16  # widths of a column and of a page in IEEE's and most journals' layouts
FONT_PT, SMALL_PT = 8.0, 7.0

# Okabe and Ito (2008): colours that colour-blind people can distinguish, with markers and line styles that need no
# colour. A planner has the same colour in pages (apps/page/src/data.ts).
_COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"]
_MARKERS = ["o", "s", "^", "D", "v", "P", "X", "<", ">"]
_LINES = ["-", (0, (5, 1.5)), (0, (1, 1.2)), (0, (5, 1.5, 1, 1.5)), (0, (3, 1, 1, 1, 1, 1))]
GREY = "#666666"

_SETTINGS = {
    "font.family": "DejaVu Sans",
    "font.size": FONT_PT,
    "axes.labelsize": FONT_PT,
    "axes.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.axisbelow": True,
    "axes.formatter.useoffset": False,
    "axes.grid": True,
    "axes.grid.axis": "y",
    "grid.color": "#DDDDDD",
    "grid.linewidth": 0.5,
    "xtick.labelsize": SMALL_PT,
    "ytick.labelsize": SMALL_PT,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "xtick.minor.width": 0.4,
    "ytick.minor.width": 0.4,
    "xtick.major.size": 2.5,
    "ytick.major.size": 2.5,
    "xtick.minor.size": 1.5,
    "ytick.minor.size": 1.5,
    "legend.fontsize": SMALL_PT,
    "legend.frameon": False,
    "legend.columnspacing": 1.2,
    "legend.borderaxespad": 0.0,
    "lines.linewidth": 1.2,
    "lines.markersize": 4.0,
    "figure.constrained_layout.use": True,
    "figure.constrained_layout.h_pad": 0.02,
    "figure.constrained_layout.w_pad": 0.02,
    "pdf.fonttype": 42,  # fonts as text, as publishers require
    "svg.hashsalt": "avoidbench",
    "savefig.dpi": 300,
}


def apply():
    """Sets matplotlib up, whatever the user's own settings."""
    matplotlib.rcdefaults()
    matplotlib.rcParams.update(_SETTINGS)


def save(figure, path):
    """Writes the figure without dates, so that the same results give the same bytes."""
    metadata = {"pdf": {"CreationDate": None}, "svg": {"Date": None}}.get(path.suffix[1:], {"Software": None})
    figure.savefig(path, metadata=metadata)


def looks(planners):
    """Colour, marker and line style of each planner, by its place among all of the sweep."""
    return {
        name: {
            "color": _COLOURS[i % len(_COLOURS)],
            "marker": _MARKERS[i % len(_MARKERS)],
            "linestyle": _LINES[i % len(_LINES)],
        }
        for i, name in enumerate(planners)
    }


def shortened(label, most=24):
    """The label with its middle cut out if it is too long: planners of a sweep often differ at the end."""
    if len(label) <= most:
        return label
    head = (most - 1) // 2
    return label[:head] + "…" + label[len(label) - (most - 1 - head) :]


def literal(text):
    """The text for Matplotlib, which takes $ for mathematics."""
    return text.replace("$", r"\$")


def shown(label):
    """The label as a figure shows it. Legends leave out what begins with an underscore."""
    text = literal(shortened(label))
    return "\u200b" + text if text.startswith("_") else text


def column_figure(height_in, planners=()):
    """A figure one column wide; higher if the legend of `planners` takes more than one line."""
    return pyplot.subplots(figsize=(COLUMN_IN, height_in + 0.14 * (legend_shape(planners, COLUMN_IN)[0] - 1)))


def page_figure(rows, columns, height_in):
    figure, axes = pyplot.subplots(rows, columns, figsize=(PAGE_IN, height_in))
    figure.get_layout_engine().set(w_pad=0.04, h_pad=0.03, wspace=0.03)
    return figure, axes


def legend_shape(planners, width_in, has_lines=True):
    """Rows and columns of a legend of at most this width."""
    if not planners:
        return 1, 0
    longest = max(len(shortened(name)) for name in planners)
    columns = max(1, min(len(planners), int(width_in / (0.062 * longest + (0.55 if has_lines else 0.4)))))
    rows = -(-len(planners) // columns)
    return rows, -(-len(planners) // rows)  # as even as they go


def planner_legend(target, planners, width_in, has_lines=True):
    """A legend above the plot, in as many columns as the width takes. `target` is the axes, or the figure of
    several."""
    look = looks(planners)
    handles = [
        matplotlib.lines.Line2D(
            [], [], label=shown(name), **(look[name] if has_lines else {**look[name], "linestyle": "none"})
        )
        for name in planners
    ]
    rows, columns = legend_shape(planners, width_in, has_lines)
    options = {"handles": handles, "ncol": columns, "handlelength": 2.4 if has_lines else 1.0}
    if isinstance(target, matplotlib.figure.Figure):
        # constrained_layout reserves no space for a figure's legend: an empty title does.
        target.suptitle("\n" * (rows - 1) + " ", fontsize=1.3 * FONT_PT)
        return target.legend(loc="upper center", bbox_to_anchor=(0.5, 0.995), **options)
    return target.legend(loc="lower center", bbox_to_anchor=(0.5, 1.02), **options)
