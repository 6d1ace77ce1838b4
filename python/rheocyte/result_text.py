"""What the pictures write about a result: its numbers, the cell it was asked for, and why it is not that state."""

import textwrap

import numpy as np


def written(law):
    """A case's name of an elastic law as text: people are written with capitals."""
    for name in ("hookean", "mooney", "rivlin", "fung", "skalak"):
        law = law.replace(name, name.capitalize())
    return law


def made_of(result):
    """Laws and moduli of interior and cortex, as far as the cell has them."""
    cell = find(result, "case", "cell")
    bulk, cortex = find(cell, "bulk", "law"), find(cell, "cortex", "law") or "none"
    modulus = (part("E = {:.4g} kPa", result, "young_modulus_reached_kPa")
               or part("E = {:.4g} kPa", cell, "bulk", "young_modulus_kPa"))
    parts = [] if bulk in (None, "none") else [f"{written(bulk)} solid", modulus]
    if cortex != "none":
        parts += [f"{written(cortex)} {'shell' if bulk == 'none' else 'cortex'}",
                  part("E2D = {:.4g} mN/m", result, "cortex_modulus_reached_mN_per_m")]
    if find(result, "tension_mN_per_m"):
        parts.append(part("γ = {:.3g} mN/m", result, "tension_mN_per_m"))
    return parts


def elongated_by(result):
    """What draws the cell out along the flow beside the flow itself."""
    aspect, tension = find(result, "case", "cell", "rest_aspect"), find(result, "case", "flow", "axial_tension_Pa")
    return [f"rest aspect {aspect:.3g}" if aspect not in (None, 1) else None,
            f"axial tension {tension:.4g} Pa" if tension else None]


def deformation_with_error(result):
    """Deformation and its estimated absolute error, with as many digits as the error leaves."""
    deformation, relative = find(result, "deformation"), find(result, "estimated_error")
    if find(result, "case", "numerics", "accuracy_of") == "motion":
        relative = None
    if not isinstance(deformation, (int, float)):
        return None
    if not isinstance(relative, (int, float)) or not relative > 0 or not deformation > 0:
        compared = find(result, "time", "comparison") or "converged"
        return f"deformation {deformation:.4g}" + ("" if compared == "converged" else ", error not known")
    error = relative * max(deformation, find(result, "deformation_floor") or 0)
    digits = int(np.clip(np.ceil(-np.log10(error)), 1, 9))
    return f"deformation {deformation:.{digits}f} ± {error:.{digits}f}"


def find(result, *keys):
    """The value under nested keys, None if there is none."""
    for key in keys:
        result = result.get(key) if isinstance(result, dict) else None
    return result


def part(text, result, *keys):
    """The value under the keys put into the text; nothing if the result does not hold it."""
    value = find(result, *keys)
    try:
        return None if value is None else text.format(value)
    except (TypeError, ValueError):
        return None


def failure_note(result):
    """Lines that say why this is not the state that was asked for, and which one it is; empty if it is."""
    if result["status"] == "converged":
        return []
    lines = [f"NOT THE STATE THAT WAS ASKED FOR: {result['status']}"]
    for name, unit, reached, *asked in (
            ("E", "kPa", "young_modulus_reached_kPa", "bulk", "young_modulus_kPa"),
            ("E2D", "mN/m", "cortex_modulus_reached_mN_per_m", "cortex", "modulus_mN_per_m")):
        drawn, wanted = find(result, reached), find(result, "case", "cell", *asked)
        if drawn and wanted and abs(drawn / wanted - 1) > 1e-6:
            lines.append(f"drawn is {name} = {drawn:.4g} {unit}, requested was {wanted:.4g} {unit}")
    return lines + textwrap.wrap(str(result.get("message") or ""), 64, max_lines=3, placeholder=" …")
