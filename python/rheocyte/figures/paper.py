"""Cells and conditions of Mokbel et al. 2017 as cases: dictionaries with the keys of `rheocyte help case`.

The paper's figures are rescaled from simulations at R = 10 um to R = 10.94 um; cases with the figures' values are
therefore solved at R = 10.94 um.
"""

CHANNEL_RADIUS_UM = 10.94
CONDITIONS = {"channel.radius_um": CHANNEL_RADIUS_UM, "flow.rate_ul_per_s": 0.04, "flow.viscosity_mPas": 15.0,
              "flow.density_kg_per_m3": 1000.0}
TENSION_RATIO = 0.1


def solid(radius_um, young_modulus_kPa, law, **numerics):
    """A cell that is elastic throughout, without a cortex."""
    return {**CONDITIONS, "cell.radius_um": radius_um, "cell.bulk.law": law,
            "cell.bulk.young_modulus_kPa": young_modulus_kPa, **section("numerics", numerics)}


def shell(radius_um, modulus_mN_per_m, law, **numerics):
    """An elastic cortex with the paper's surface tension round a liquid."""
    return {**CONDITIONS, "cell.radius_um": radius_um, "cell.bulk.law": "none", "cell.cortex.law": law,
            "cell.cortex.modulus_mN_per_m": modulus_mN_per_m, "cell.cortex.tension_ratio": TENSION_RATIO,
            **section("numerics", numerics)}


def section(name, values):
    """Keys of one section of a case."""
    return {f"{name}.{key}": value for key, value in values.items()}
