"""population.json of version 0.3.0 with the names that its numbers have now; the next version will not read it any more."""

_ROWS = {"median_radius_um": "radius_median_um", "spread_of_ln_radius": "radius_ln_spread", "name": "condition"}


def renamed(record):
    """The record with the names of today; itself if it has them."""
    if record.get("schema") != 1:
        return record
    quantities = {each["key"]: _quantity(each) for each in record["quantities"]}
    return {**record, "quantities": [*quantities.values()],
            "conditions": [_row(each, quantities) for each in record["conditions"]],
            "recordings": [_row({**each, **(each.get("population") or {})}, quantities) for each in record["recordings"]],
            "comparisons": [_comparison(each, quantities) for each in record["comparisons"]]}


def _quantity(each):
    suffix = each["unit"].replace("/", "_per_")
    name = each["key"].removesuffix("_" + suffix)
    return {"quantity": name, "median": f"{name}_median_{suffix}", "symbol": each["symbol"], "unit": each["unit"]}


def _interval(name, found):
    return {name: found["value"], f"{name}_low": found["lower"], f"{name}_high": found["upper"]}


def _row(row, quantities):
    """Of a recording or a condition."""
    row = {_ROWS.get(name, name): value for name, value in row.items()}
    for key, each in quantities.items():
        if f"median_{key}" in row:
            row.update(_interval(each["median"], row[f"median_{key}"]))
            row[f"{each['quantity']}_ln_spread"] = row.get(f"spread_of_ln_{key}", row.get("spread_of_ln_modulus"))
            row[f"{each['quantity']}_interval_by"] = row.get("interval_by")
    return row


def _comparison(row, quantities):
    sampling = _interval("ratio_by_sampling", row["ratio_by_sampling_alone"])
    return {**row, **_interval("ratio", row["ratio"]), **sampling, "quantity": quantities[row["quantity"]]["quantity"]}
