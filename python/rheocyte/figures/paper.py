"""Cells and conditions of Mokbel et al. 2017 as cases: dictionaries with the keys of `rheocyte help case`.

The paper's figures are rescaled from simulations at R = 10 um to R = 10.94 um; cases with the figures' values are
therefore solved at R = 10.94 um.
"""

CHANNEL_RADIUS_UM = 10.94
CONDITIONS = {"channel.radius_um": CHANNEL_RADIUS_UM, "flow.rate_ul_per_s": 0.04, "flow.viscosity_mPas": 15.0,
              "flow.density_kg_per_m3": 1000.0}
TENSION_RATIO = 0.1
YOUNG_MODULI_KPA = [2.29, 3.44, 4.58, 5.73, 6.87, 9.16, 11.45]
CORTEX_MODULI_MN_PER_M = [20.9, 31.3, 41.8, 52.2, 62.7, 73.1, 83.6]
AREAS_UM2 = (50.0, 250.0)  # of the lines
# Beyond the areas of the lines, so that these are complete; radii equally spaced.
TABLE = {"table.min_area_um2": 40.0, "table.max_area_um2": 280.0, "table.radii": 12,
         "table.rows_per_radius": 240, "table.accuracy": 1e-3}


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


def solid_table(name, law):
    """Spec of a table that holds the lines of the solids."""
    return {**CONDITIONS, "cell.bulk.law": law, "table.identifier": name, **TABLE,
            "table.min_deformation": 3e-4, "table.max_deformation": 0.12}


def shell_table(name, law):
    """Spec of a table that holds the lines of the shells."""
    return {**CONDITIONS, "cell.bulk.law": "none", "cell.cortex.law": law, "cell.cortex.tension_ratio": TENSION_RATIO,
            "table.identifier": name, **TABLE, "table.min_deformation": 8e-5, "table.max_deformation": 0.08}
