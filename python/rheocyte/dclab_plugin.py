"""A plugin feature of dclab and DCscope: Young's moduli by rheocyte's tables.

    rheocyte dclab-plugin > rheocyte_modulus.py        then choose the file in DCscope's dialogue of plugins, or
    dclab.load_plugin_feature("rheocyte_modulus.py")

Settings come from the recording: setup:channel width, flow rate, medium and temperature (or the feature temp), and
imaging:pixel size. The table is that of the medium, as `rheocyte extract` chooses it. The package rheocyte must be
installed where dclab is. Written by rheocyte; docs/python.md.
"""


def usual_temperature(dataset):
    """Degrees Celsius of the recording as a whole."""
    return dataset.config.get("setup", {}).get("temperature", 23.0)


def can_compute(dataset):
    """Whether the recording was made in the channel, in a buffer of known viscosity at a known temperature."""
    import rheocyte

    setup = dataset.config.get("setup", {})
    if setup.get("chip region", "channel") != "channel":
        return False
    if "temp" not in dataset and "temperature" not in setup:
        return False
    try:
        rheocyte.Table.for_medium(setup.get("medium", ""), temperature_C=usual_temperature(dataset))
    except rheocyte.UserError:
        return False
    return True


def inertia_ratios(dataset):
    """Those that are stored, else from the masks; NaN where there are neither."""
    import numpy as np
    import rheocyte

    if "inert_ratio_cvx" in dataset.features_innate:
        return dataset["inert_ratio_cvx"][:]
    if "mask" not in dataset:
        return np.full(len(dataset), np.nan)
    pixel, masks = dataset.config["imaging"]["pixel size"], dataset["mask"]
    parts = [rheocyte.features(np.asarray(masks[first:first + 1000]), pixel)["inert_ratio_cvx"]
             for first in range(0, len(dataset), 1000)]
    return np.concatenate(parts)


def compute(dataset):
    """Modulus (kPa), its standard error (kPa), the state and the excess of the inertia ratio of each event."""
    import rheocyte

    setup, imaging = dataset.config["setup"], dataset.config["imaging"]
    table = rheocyte.Table.for_medium(setup["medium"], temperature_C=usual_temperature(dataset))
    area, deformation = dataset["area_um"][:], dataset["deform"][:]
    seen = {"channel_width_um": setup["channel width"], "pixel_size_um": imaging["pixel size"]}
    found = table.modulus(area, deformation, flow_rate_ul_s=setup["flow rate"], medium=setup["medium"],
                          temperature_C=dataset["temp"][:] if "temp" in dataset else setup["temperature"], **seen)
    shapes = table.shapes(area, deformation, inertia_ratios(dataset), **seen)
    return {"rheocyte_modulus": found.young_modulus_kPa, "rheocyte_modulus_error": found.standard_error_kPa,
            "rheocyte_state": found.state.astype(float), "rheocyte_shape_excess": shapes.excess}


info = {
    "method": compute,
    "method check required": can_compute,
    "description": "Young's modulus by rheocyte's tables",
    "long description": "Young's modulus of each event with its standard error, corrected for pixels, by the table of the "
                        "recording's medium; and why an event has none: 0 valid, 1 no data, 2 too small, 3 too large, "
                        "4 too stiff, 5 too soft, 6 unstable, 7 unresolved, 8 regularised. The shape excess is the inertia "
                        "ratio less that of the table's cell of this area and deformation.",
    "feature names": ["rheocyte_modulus", "rheocyte_modulus_error", "rheocyte_state", "rheocyte_shape_excess"],
    "feature labels": ["Young's modulus (rheocyte) [kPa]", "Standard error of Young's modulus (rheocyte) [kPa]",
                       "State of Young's modulus (rheocyte)", "Excess of the inertia ratio (rheocyte)"],
    "features required": ["area_um", "deform"],
    "config required": [["setup", ["channel width", "flow rate", "medium"]], ["imaging", ["pixel size"]]],
    "scalar feature": [True, True, True, True],
    "version": "0.2.0",
}
