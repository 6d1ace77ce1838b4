"""The panel of a treatment study: ratios of a quantity over the dose, with the fitted response."""

import numpy as np

from rheocyte import colours


def has_doses(record, quantity):
    """Whether the record has a response of this quantity to the dose."""
    return response_of(record, quantity) is not None


def response_of(record, quantity):
    """The row of the response, None without one."""
    return next((each for each in record.get("dose_responses", []) if each["quantity"] == quantity), None)


def draw_doses(axes, story, quantity, ratios_of):
    """Dots: the recordings, over the control of their session; diamonds: the conditions; line: the fitted response."""
    record = story.record
    doses = dict(zip(story.names, record["doses"]["of_conditions"]))
    axes.axhline(1, color=colours.INK, linewidth=0.6, zorder=0)
    for each in story.comparisons(quantity["quantity"]):
        dose = doses[each["treated"]]
        if not dose:
            continue
        colour = story.colour(each["treated"])
        ratios = ratios_of(story, each, quantity["median"])
        axes.plot([dose] * len(ratios), ratios, "o", markersize=3.6, color=colour, alpha=0.75, zorder=3)
        axes.plot(dose, each["ratio"], "D", markersize=5, color=colour, zorder=4)
        if each["p"] is not None:
            axes.plot([dose] * 2, [each["ratio_low"], each["ratio_high"]], color=colour, linewidth=2.4, alpha=0.35,
                      solid_capstyle="butt", zorder=2)
    axes.set_xscale("log")
    unit = record["doses"]["unit"]
    axes.set(xlabel=f"dose ({unit})" if unit else "dose")
    response = response_of(record, quantity["quantity"])
    axes.set_title(f"ratio, p = {response['p_of_trend']:.1g}" if response["p_of_trend"] is not None else "ratio")
    if is_determined(record, response):
        draw_response(axes, response, unit)


def is_determined(record, response):
    """Whether there is a trend, and an EC50 with both ends."""
    significant = response["p_of_trend"] is not None and response["p_of_trend"] < 1 - record["level"]
    return significant and response["ec50_low"] and response["ec50_high"] is not None


def draw_response(axes, response, unit):
    """The fitted law, with its EC50 and the interval of that."""
    low, high = axes.get_xlim()
    dose = np.geomspace(low, high, 200)
    effect = np.log(response["ratio_at_large_dose"])
    axes.plot(dose, np.exp(effect * dose / (dose + response["ec50"])), color=colours.INK, linewidth=0.9, zorder=1)
    axes.axvspan(response["ec50_low"], response["ec50_high"], color=colours.INK, alpha=0.07, linewidth=0, zorder=0)
    words = f"EC50 {response['ec50']:.2g} {unit}".rstrip()
    axes.annotate(f"{words}\n({response['ec50_low']:.2g} to {response['ec50_high']:.2g})", (0.03, 0.04),
                  xycoords="axes fraction", ha="left", va="bottom", fontsize=6)
    axes.set_xlim(low, high)
