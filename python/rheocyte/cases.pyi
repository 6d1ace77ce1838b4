# Made by `python -m rheocyte.case_stub`; the keys are declared in src/case/case_keys.cc.
from collections.abc import Mapping
from os import PathLike
from typing import Any, Literal

def case_keys() -> list[dict[str, Any]]: ...

class _ChannelProfile:
    x_um: list[float] | None  # places along a channel of varying section, instead of one width or radius; the cell starts at 0
    R_um: list[float] | None  # radii of the channel at these places, smooth and monotonic in between, constant beyond the ends
    width_um: list[float] | None  # widths at these places of a channel of constant height, linear in between, in place of radii; a tube stands for a channel whose height is the smallest width, with the same mean velocity everywhere
    rounding_um: float | None  # distance from the places over which the corners of the walls are rounded if the channel is computed in three dimensions; if not given, 0.15 of the smaller of height and minimum width
    axial_tension_Pa: list[float] | None  # uniform axial tension of the surroundings when the cell is at these places, linear in between, constant beyond the ends; in place of flow.axial_tension_Pa

class _Channel:
    section: Literal["tube", "square", "rectangle"]  # cross-section of the computed channel: tube, also as the equivalent of a square channel with the same pressure drop, or the square or rectangle itself in three dimensions
    camera: Literal["side", "diagonal"] | None  # viewing direction in a square channel, side: perpendicular to a wall, diagonal: along the diagonal of the section; a rectangle is viewed along its height
    camera_degree: float | None  # viewing angle in a square channel or a rectangle, 0: along the height, 45: along the diagonal of a square
    width_um: float | None  # width of the channel; a square channel is mapped to a tube of radius 0.547 x width unless channel.section is "square"
    height_um: float | None  # height of the channel, along which the camera looks
    radius_um: float | None  # radius of the tube
    length_um: float | None  # length of the channel over which the given pressure drops
    profile: _ChannelProfile

class _Flow:
    drive: Literal["rate", "pressure-drop", "controlled-pressure"]  # prescribed quantity: the flow rate; the pressure drop, with the flow rate as a result; the flow rate, reached by adapting the pressure drop in each step as in Mokbel et al. 2017
    rate_ul_per_s: float | None  # flow rate through the channel, sheath and sample together
    pressure_drop_Pa: float | None  # pressure drop over channel.length_um, with the cell in it
    law: Literal["newtonian", "power-law", "carreau"]  # law of the liquid, power-law: viscosity = consistency x shear rate^(exponent - 1), carreau: the Carreau-Yasuda law, with plateaus at low and high shear rates
    viscosity_mPas: float | None  # viscosity of the liquid
    consistency_Pa_sn: float | None  # consistency of the shear-thinning liquid
    exponent: float | None  # exponent n of the shear-thinning liquid, 1 = Newtonian
    zero_shear_viscosity_mPas: float | None  # zero-shear viscosity of the shear-thinning liquid
    infinite_shear_viscosity_mPas: float | None  # infinite-shear viscosity of the shear-thinning liquid
    relaxation_time_ms: float | None  # inverse of the shear rate at which thinning begins
    yasuda_exponent: float | None  # exponent a of the Carreau-Yasuda law: sharpness of the onset of thinning
    shear_rate_floor: float | None  # shear rate, relative to mean speed / tube radius, below which the viscosity levels off
    density_kg_per_m3: float | None  # density of the liquid, 0 = no inertia (Stokes flow)
    axial_tension_Pa: float | None  # uniform tension of the surroundings along the flow, as in an elastic liquid: a traction T n_x e_x on the cell

class _CellBulk:
    law: Literal["linear", "neo-hookean", "mooney-rivlin", "fung", "none"]  # elastic law of the cell's interior, fung: neo-hookean with exponential strain stiffening; none: a liquid, so that the cell is a shell
    young_modulus_kPa: float | None  # Young's modulus of the cell's interior, which is incompressible
    c1_fraction: float | None  # fraction of the neo-hookean term in the mooney-rivlin law, the rest is linear
    stiffening: float | None  # strain stiffening b of the fung law, whose stress is the neo-hookean stress times exp(b (I1 - 3)), with I1 the sum of the squared stretches; 0 = neo-hookean

class _CellCortex:
    law: Literal["none", "linear", "thin-shell", "neo-hookean", "neo-hookean-reference", "skalak"]  # elastic law of the cell's surface, the cortex
    modulus_mN_per_m: float | None  # elastic modulus E2D of the cortex, Young's modulus x thickness
    area_constant: float | None  # constant C of the skalak law, the resistance of the cortex to a change of its area; its Poisson's ratio is C / (1 + C)
    tension_mN_per_m: float | None  # surface tension of the cell
    tension_ratio: float | None  # surface tension as a fraction of the modulus of the cortex
    bending_kBT: float | None  # bending stiffness c_b of the cell's surface in units of k_B T at 25 degrees C (4.116e-21 J)

class _Cell:
    radius_um: float | None  # radius of the unstressed, spherical cell, 0.05 .. 0.965 of the tube radius or of half the smaller width
    offset_um: list[float] | None  # position of a cell off the axis of a duct, [along the width, along the height], in time its initial position; one of the two is 0, and the camera looks along the other
    place: Literal["given", "equilibrium"] | None  # position of a cell off the axis, given: at its offset; equilibrium: where it does not drift, searched from its offset along the drift
    rest_aspect: float | None  # length over width of the stress-free cell, a spheroid along the flow with the volume of the sphere
    viscosity_mPas: float | None  # viscosity of the cell's interior; a stationary shape does not depend on it
    viscoelasticity: Literal["kelvin-voigt", "maxwell", "standard-linear-solid"] | None  # arrangement of the viscosity and the elastic interior, kelvin-voigt: in parallel; maxwell: in series; standard-linear-solid: the viscosity in series with a second spring, both in parallel with the elastic interior
    branch_modulus_kPa: float | None  # Young's modulus of the spring in series with the viscosity
    density_kg_per_m3: float | None  # density of the cell
    bulk: _CellBulk
    cortex: _CellCortex

class _Time:
    scheme: Literal["stationary", "monolithic", "partitioned"]  # stationary: only the final shape; monolithic: its development, in implicit steps of controlled size; partitioned: its development by the splitting of Mokbel et al. 2017
    end_us: float | None  # time for which the cell, initially a sphere, is followed; in a straight channel, or downstream of the last change of the wall, the implicit steps end as soon as its shape has settled
    end_um: float | None  # distance along the channel over which the cell is followed, in place of the time
    output_every_us: float | None  # time between measures, contours, fields and frames of the animation
    output_every_um: float | None  # distance travelled by the cell between them, in place of the time
    accuracy: float | None  # requested accuracy of the positions of the surface in each step, relative to the radius
    step_us: float | None  # time step of the splitting, which is explicit in the elasticity
    grid_um: float | None  # size of the elements along the cell's surface, 0.2 in Mokbel et al. 2017; 0: the mesh of the implicit steps
    start_stretch: float | None  # initial uniform stretch of the cell along the flow; its unstressed state is the sphere
    mesh_accuracy: float | None  # requested relative accuracy of the deformation as far as it depends on the mesh; mesh and degree are chosen accordingly
    degree: float | None  # polynomial degree of the spaces on a mesh of 48 or more elements, in place of the accuracy; in three dimensions at most 6

class _Numerics:
    accuracy: float | None  # requested relative accuracy of the deformation; mesh and degree are chosen accordingly
    accuracy_of: Literal["deformation", "motion"] | None  # quantity to which the accuracy refers for a cell off the axis, deformation: of its silhouette, below 1e-4 relative to 1e-4; motion: velocity, rotation, and drift or the place where the cell does not drift

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
