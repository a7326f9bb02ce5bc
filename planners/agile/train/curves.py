"""Draws how a training went."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

TRAINING, VALIDATION, EXPERT = "#0072B2", "#D55E00", "#009E73"
# Title, figures with their lines' style, logarithmic.
PANELS: tuple[tuple[str, tuple[tuple[str, str, str], ...], bool], ...] = (
    ("loss", (("loss", "-", ""),), False),
    ("error to the labels, (v_des T)²", (("label_error", "-", ""),), True),
    ("cost J", (("chosen_cost", "-", "least alpha"), ("best_cost", ":", "best of three")), False),
    (
        "share of trajectories nearer than 0.3 m",
        (("chosen_collision", "-", "least alpha"), ("best_collision", ":", "best of three")),
        False,
    ),
    ("mean square error of alpha", (("alpha_error", "-", ""),), True),
    ("learning rate", (("rate", "-", ""),), False),
)


def draw(rows: list[dict[str, Any]], expert: dict[str, float], title: str, picture: Path) -> None:
    """Draws rows of the log: each has seconds and training or validation, with figures by name."""
    figure = Figure(figsize=(11.0, 6.0), layout="constrained")
    FigureCanvasAgg(figure)
    figure.suptitle(title, fontsize=10)
    for axes, (name, lines, logarithmic) in zip(figure.subplots(2, 3).flat, PANELS):
        for key, style, label in lines:
            for part, colour in (("training", TRAINING), ("validation", VALIDATION)):
                points = [(row["seconds"] / 60.0, row[part][key]) for row in rows if key in row.get(part, {})]
                if points:
                    axes.plot(
                        *zip(*points), style, color=colour, linewidth=1.2, label=", ".join(filter(None, (part, label)))
                    )
            if key in expert:
                axes.axhline(expert[key], color=EXPERT, linewidth=0.8, linestyle="--", label="expert, validation")
        axes.set_title(name, fontsize=9)
        axes.set_xlabel("min", fontsize=8)
        axes.tick_params(labelsize=8)
        axes.grid(alpha=0.3)
        if logarithmic:
            axes.set_yscale("log")
        else:
            axes.set_ylim(bottom=0.0)
        if axes.get_legend_handles_labels()[0]:
            axes.legend(fontsize=7)
    figure.savefig(picture, dpi=110, metadata={"Software": None})
