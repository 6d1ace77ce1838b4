# Made by `python -m rheocyte.case_stub`; the keys are declared in src/case/case_keys.cc.
from collections.abc import Mapping
from os import PathLike
from typing import Any, Literal

def case_keys() -> list[dict[str, Any]]: ...

class _ChannelProfile:
    x_um: list[float] | None  # places along a channel that is not straight, in place of its width or radius; the cell starts at 0
    R_um: list[float] | None  # radii of the wall at these places, smooth and monotonic in between, constant beyond the ends
    width_um: list[float] | None  # widths at these places of a channel of constant height, linear in between, in place of radii; a tube stands for a height of the least of them, with the same mean speed everywhere
    rounding_um: float | None  # how far from the places the corners of the walls are rounded where the channel is computed in three dimensions; if it is not given, 0.15 of the lesser of height and least width
    axial_tension_Pa: list[float] | None  # even axial tension of the surroundings where the cell is at these places, linear in between, constant beyond the ends; in place of flow.axial_tension_Pa

class _Channel:
    section: Literal["tube", "square", "rectangle"]  # cross-section that is computed: a tube, which also stands for the square channel of the same pressure drop, or the square or a rectangle itself in three dimensions
    camera: Literal["side", "diagonal"] | None  # from where a square channel is seen, side: at right angles to a wall, diagonal: along the section's diagonal; a rectangle is seen along its height
    camera_degree: float | None  # from where a square channel or a rectangle is seen, 0: along the height, 45: along the diagonal of a square
    width_um: float | None  # width of the channel; of a square one it is mapped to a tube of radius 0.547 x width unless channel.section is "square"
    height_um: float | None  # height of the channel, along which the camera looks
    radius_um: float | None  # radius of the tube
    length_um: float | None  # length of the channel over which the given pressure drops
    profile: _ChannelProfile

class _Flow:
    drive: Literal["rate", "pressure-drop", "controlled-pressure"]  # what is given: the flow rate; the pressure drop, with the flow rate as a result; the flow rate, reached through a pressure drop that is adapted in each step as in Mokbel et al. 2017
    rate_ul_per_s: float | None  # flow rate through the channel, sheath and sample together
    pressure_drop_Pa: float | None  # pressure drop over channel.length_um, with the cell in it
    law: Literal["newtonian", "power-law", "carreau"]  # law of the liquid, power-law: viscosity = consistency x shear rate^(exponent - 1), carreau: that of Carreau and Yasuda, with plateaus at low and high shear rates
    viscosity_mPas: float | None  # viscosity of the liquid
    consistency_Pa_sn: float | None  # consistency of the shear-thinning liquid
    exponent: float | None  # exponent n of the shear-thinning liquid, 1 = Newtonian
    zero_shear_viscosity_mPas: float | None  # viscosity of the shear-thinning liquid at rest
    infinite_shear_viscosity_mPas: float | None  # viscosity of the shear-thinning liquid at very high shear rates
    relaxation_time_ms: float | None  # inverse of the shear rate at which thinning begins
    yasuda_exponent: float | None  # exponent a of Carreau and Yasuda's law: how sharply thinning begins
    shear_rate_floor: float | None  # shear rate, relative to mean speed / tube radius, below which the viscosity levels off
    density_kg_per_m3: float | None  # density of the liquid, 0 = no inertia (Stokes flow)
    axial_tension_Pa: float | None  # even tension of the surroundings along the flow, as of an elastic liquid: a traction T n_x e_x on the cell

class _CellBulk:
    law: Literal["linear", "neo-hookean", "mooney-rivlin", "fung", "none"]  # elastic law of the cell's interior, fung: the neo-hookean one, stiffening exponentially with the strain; none: a liquid, which makes the cell a shell
    young_modulus_kPa: float | None  # Young's modulus of the cell's interior, which is incompressible
    c1_fraction: float | None  # fraction of the neo-hookean law in the mooney-rivlin one, the rest is linear
    stiffening: float | None  # b of the fung law, whose stress is the neo-hookean one times exp(b (I1 - 3)), with I1 the sum of the squared stretches; 0 = neo-hookean

class _CellCortex:
    law: Literal["none", "linear", "thin-shell", "neo-hookean", "neo-hookean-reference", "skalak"]  # elastic law of the cell's surface, the cortex
    modulus_mN_per_m: float | None  # elastic modulus E2D of the cortex, Young's modulus x thickness
    area_constant: float | None  # constant C of the skalak law, the resistance of the cortex to a change of its area; its Poisson's ratio is C / (1 + C)
    tension_mN_per_m: float | None  # surface tension of the cell
    tension_ratio: float | None  # surface tension as a fraction of the modulus of the cortex
    bending_kBT: float | None  # bending stiffness c_b of the cell's surface in units of k_B T at 25 degrees C (4.116e-21 J)

class _Cell:
    radius_um: float | None  # radius of the unstressed, spherical cell, 0.05 .. 0.965 of the tube radius or of half the lesser width
    offset_um: list[float] | None  # place of a cell off the axis of a duct, [along the width, along the height], in time where it starts; one of the two is 0, and the camera looks along the other
    place: Literal["given", "equilibrium"] | None  # where a cell off the axis is, given: at its offset; equilibrium: where it does not drift, sought from there along the drift
    rest_aspect: float | None  # length over width of the cell without stress, a spheroid along the flow with the volume of the sphere
    viscosity_mPas: float | None  # viscosity of the cell's interior; a stationary shape does not depend on it
    viscoelasticity: Literal["kelvin-voigt", "maxwell", "standard-linear-solid"] | None  # what the viscosity is to the elastic interior, kelvin-voigt: beside it; maxwell: in series with it; standard-linear-solid: in series with a spring of its own, both beside it
    branch_modulus_kPa: float | None  # Young's modulus of the spring in series with the viscosity
    density_kg_per_m3: float | None  # density of the cell
    bulk: _CellBulk
    cortex: _CellCortex

class _Time:
    scheme: Literal["stationary", "monolithic", "partitioned"]  # stationary: the final shape at once; monolithic: the way to it, in implicit steps of controlled size; partitioned: in the splitting of Mokbel et al. 2017
    end_us: float | None  # time to follow the cell, which starts as a sphere; in a straight channel, or behind the last change of the wall, the implicit steps end as soon as its shape has settled
    end_um: float | None  # way along the channel to follow the cell, in place of the time
    output_every_us: float | None  # time between measures, contours, fields and frames of the animation
    output_every_um: float | None  # way of the cell between them, in place of the time
    accuracy: float | None  # wanted accuracy of the surface's positions in each step, relative to the radius
    step_us: float | None  # step of the splitting, which is explicit in the elasticity
    grid_um: float | None  # size of the elements along the cell's surface, 0.2 in Mokbel et al. 2017; 0: the mesh of the implicit steps
    start_stretch: float | None  # stretch along the flow with which the cell starts, all of it alike; its unstressed state is the sphere
    mesh_accuracy: float | None  # wanted accuracy of the deformation as far as it depends on the mesh, relative; mesh and degree are chosen for it
    degree: float | None  # polynomial degree of the spaces on a mesh of 48 or more elements, in place of the accuracy; in three dimensions at most 6

class _Numerics:
    accuracy: float | None  # wanted relative accuracy of the deformation, mesh and degree are chosen for it
    accuracy_of: Literal["deformation", "motion"] | None  # what the accuracy is wanted of for a cell off the axis, deformation: of its silhouette, below 1e-4 relative to 1e-4; motion: of its velocity, its rotation, and its drift or the place where it does not drift

class Case:
    channel: _Channel
    flow: _Flow
    cell: _Cell
    time: _Time
    numerics: _Numerics
    def __init__(self, source: str | PathLike[str] | Mapping[str, Any] | Case | None = None, **overrides: Any) -> None: ...
    def replace(self, **overrides: Any) -> Case: ...
    def to_dict(self) -> dict[str, Any]: ...
    def to_toml(self) -> str: ...
    @property
    def hash(self) -> str: ...
