#include "case/case_keys.h"

#include <array>

namespace rheocyte {

namespace {

constexpr Condition newtonian{"flow.law", "newtonian"}, power_law{"flow.law", "power-law"},
    carreau{"flow.law", "carreau"}, shear_thinning{"flow.law", "newtonian", true},
    mooney_rivlin{"cell.bulk.law", "mooney-rivlin"}, fung{"cell.bulk.law", "fung"}, skalak{"cell.cortex.law", "skalak"},
    has_bulk{"cell.bulk.law", "none", true}, has_shell{"cell.cortex.law", "none", true},
    in_time{"time.scheme", "stationary", true}, in_duct{"channel.section", "tube", true},
    has_offset{"cell.offset_um", ""}, rectangle{"channel.section", "rectangle"},
    monolithic{"time.scheme", "monolithic"}, partitioned{"time.scheme", "partitioned"},
    linear_solid{"cell.viscoelasticity", "standard-linear-solid"}, has_rate{"flow.drive", "pressure-drop", true},
    has_pressure_drop{"flow.drive", "pressure-drop"};

// The member of a case is the name of its key; behind it stand the other parts of its KeyDescription in their order.
#define FIELD(member) ([](auto& c) -> auto& { return c.member; })
#define KEY(member, ...) key_of<Case, FIELD(member)>({#member, __VA_ARGS__})

// The options of a choice stand in the order of its enumeration (case/problem.h, laws/).
// The ranges are wide; they catch wrong units and keep every dimensionless group finite.
const std::array table = {
    KEY(channel.section, "",
        "cross-section of the computed channel: tube, also as the equivalent of a square channel with the same "
        "pressure drop, or the square or rectangle itself in three dimensions",
        Choice{{"tube", "square", "rectangle"}}, 0),
    KEY(channel.camera, "",
        "viewing direction in a square channel, side: perpendicular to a wall, diagonal: along the diagonal of the "
        "section; a rectangle is viewed along its height",
        Choice{{"side", "diagonal"}}, 0, in_duct, "channel.camera_degree"),
    KEY(channel.camera_degree, "degree",
        "viewing angle in a square channel or a rectangle, 0: along the height, 45: along the diagonal of a square",
        Number{{0, 90}}, absent, in_duct, "channel.camera"),
    KEY(channel.width_um, "um",
        "width of the channel; a square channel is mapped to a tube of radius 0.547 x width unless channel.section is "
        "\"square\"",
        Number{{1, 10000}}, required, {}, "channel.radius_um", "--channel-width-um", "--channel-width"),
    KEY(channel.height_um, "um", "height of the channel, along which the camera looks", Number{{1, 10000}}, required,
        rectangle),
    KEY(channel.radius_um, "um", "radius of the tube", Number{{0.5, 5000}}, required, {}, "channel.width_um",
        "--tube-radius-um"),
    KEY(channel.length_um, "um", "length of the channel over which the given pressure drops", Number{{1, 1e6}},
        required, has_pressure_drop),
    KEY(channel.profile.x_um, "um",
        "places along a channel of varying section, instead of one width or radius; the cell starts at 0",
        List{{-1e6, 1e6}}, absent, monolithic),
    KEY(channel.profile.R_um, "um",
        "radii of the channel at these places, smooth and monotonic in between, constant beyond the ends",
        List{{0.5, 5000}}, absent, monolithic, "channel.profile.width_um"),
    KEY(channel.profile.width_um, "um",
        "widths at these places of a channel of constant height, linear in between, in place of radii; a tube stands "
        "for a channel whose height is the smallest width, with the same mean velocity everywhere",
        List{{1, 10000}}, absent, monolithic, "channel.profile.R_um"),
    KEY(channel.profile.rounding_um, "um",
        "distance from the places over which the corners of the walls are rounded if the channel is computed in three "
        "dimensions; if not given, 0.15 of the smaller of height and minimum width",
        Number{{1e-3, 1e4}}, absent, in_duct),
    KEY(channel.profile.axial_tension_Pa, "Pa",
        "uniform axial tension of the surroundings when the cell is at these places, linear in between, constant "
        "beyond the ends; in place of flow.axial_tension_Pa",
        List{{-1e4, 1e5}}, absent, monolithic),

    KEY(flow.drive, "",
        "prescribed quantity: the flow rate; the pressure drop, with the flow rate as a result; the flow rate, reached "
        "by adapting the pressure drop in each step as in Mokbel et al. 2017",
        Choice{{"rate", "pressure-drop", "controlled-pressure"},
               Implied{"pressure-drop", "flow.pressure_drop_Pa", "flow.rate_ul_per_s"}},
        0),
    KEY(flow.rate_ul_per_s, "ul/s", "flow rate through the channel, sheath and sample together", Number{{1e-9, 1e3}},
        required, has_rate, {}, "--flow-rate-ul-s", "--flow-rate"),
    KEY(flow.pressure_drop_Pa, "Pa", "pressure drop over channel.length_um, with the cell in it", Number{{1e-6, 1e12}},
        required, has_pressure_drop),
    KEY(flow.law, "",
        "law of the liquid, power-law: viscosity = consistency x shear rate^(exponent - 1), carreau: the "
        "Carreau-Yasuda law, with plateaus at low and high shear rates",
        Choice{{"newtonian", "power-law", "carreau"}}, 0),
    KEY(flow.viscosity_mPas, "mPa s", "viscosity of the liquid", Number{{1e-3, 1e7}}, required, newtonian, {},
        "--viscosity-mPas", "--viscosity"),
    KEY(flow.consistency_Pa_sn, "Pa s^n", "consistency of the shear-thinning liquid", Number{{1e-6, 1e4}}, required,
        power_law),
    KEY(flow.exponent, "", "exponent n of the shear-thinning liquid, 1 = Newtonian", Number{{0.1, 2}}, required,
        shear_thinning),
    KEY(flow.zero_shear_viscosity_mPas, "mPa s", "zero-shear viscosity of the shear-thinning liquid",
        Number{{1e-3, 1e7}}, required, carreau),
    KEY(flow.infinite_shear_viscosity_mPas, "mPa s", "infinite-shear viscosity of the shear-thinning liquid",
        Number{{0, 1e7}}, 0.0, carreau),
    KEY(flow.relaxation_time_ms, "ms", "inverse of the shear rate at which thinning begins", Number{{1e-9, 1e9}},
        required, carreau),
    KEY(flow.yasuda_exponent, "", "exponent a of the Carreau-Yasuda law: sharpness of the onset of thinning",
        Number{{0.5, 5}}, 2.0, carreau),
    KEY(flow.shear_rate_floor, "",
        "shear rate, relative to mean speed / tube radius, below which the viscosity levels off", Number{{1e-6, 1}},
        0.01, power_law),
    KEY(flow.density_kg_per_m3, "kg/m3", "density of the liquid, 0 = no inertia (Stokes flow)", Number{{0, 1e6}},
        1000.0),
    KEY(flow.axial_tension_Pa, "Pa",
        "uniform tension of the surroundings along the flow, as in an elastic liquid: a traction T n_x e_x on the cell",
        Number{{-1e4, 1e5}}, 0.0),

    KEY(cell.radius_um, "um",
        "radius of the unstressed, spherical cell, 0.05 .. 0.965 of the tube radius or of half the smaller width",
        Number{{0.01, 5000}}, required, {}, {}, "--radius-um"),
    KEY(cell.offset_um, "um",
        "position of a cell off the axis of a duct, [along the width, along the height], in time its initial position; "
        "one of the two is 0, and the camera looks along the other",
        List{{-5000, 5000}}, absent, in_duct),
    KEY(cell.place, "",
        "position of a cell off the axis, given: at its offset; equilibrium: where it does not drift, searched from "
        "its offset along the drift",
        Choice{{"given", "equilibrium"}}, 0, in_duct),
    KEY(cell.rest_aspect, "",
        "length over width of the stress-free cell, a spheroid along the flow with the volume of the sphere",
        Number{{0.5, 3}}, 1.0),
    KEY(cell.viscosity_mPas, "mPa s", "viscosity of the cell's interior; a stationary shape does not depend on it",
        Number{{1e-3, 1e9}}, required, in_time),
    KEY(cell.viscoelasticity, "",
        "arrangement of the viscosity and the elastic interior, kelvin-voigt: in parallel; maxwell: in series; "
        "standard-linear-solid: the viscosity in series with a second spring, both in parallel with the elastic "
        "interior",
        Choice{{"kelvin-voigt", "maxwell", "standard-linear-solid"}}, 0, monolithic),
    KEY(cell.branch_modulus_kPa, "kPa", "Young's modulus of the spring in series with the viscosity",
        Number{{1e-6, 1e9}}, required, linear_solid),
    KEY(cell.density_kg_per_m3, "kg/m3", "density of the cell", Number{{0, 1e6}}, 1000.0, in_time),
    KEY(cell.bulk.law, "",
        "elastic law of the cell's interior, fung: neo-hookean with exponential strain stiffening; none: a liquid, so "
        "that the cell is a shell",
        Choice{{"linear", "neo-hookean", "mooney-rivlin", "fung", "none"}}, 1),
    KEY(cell.bulk.young_modulus_kPa, "kPa", "Young's modulus of the cell's interior, which is incompressible",
        Number{{1e-6, 1e9}}, required, has_bulk, {}, "--young-modulus-kPa"),
    KEY(cell.bulk.c1_fraction, "", "fraction of the neo-hookean term in the mooney-rivlin law, the rest is linear",
        Number{{0, 1}}, 0.5, mooney_rivlin, {}, {}, {}, "cell.bulk.mooney_share"),
    KEY(cell.bulk.stiffening, "",
        "strain stiffening b of the fung law, whose stress is the neo-hookean stress times exp(b (I1 - 3)), with I1 "
        "the sum of the squared stretches; 0 = neo-hookean",
        Number{{0, 100}}, 1.0, fung),

    KEY(cell.cortex.law, "", "elastic law of the cell's surface, the cortex",
        Choice{{"none", "linear", "thin-shell", "neo-hookean", "neo-hookean-reference", "skalak"}}, 0),
    KEY(cell.cortex.modulus_mN_per_m, "mN/m", "elastic modulus E2D of the cortex, Young's modulus x thickness",
        Number{{1e-6, 1e9}}, required, has_shell, {}, "--cortex-modulus-mN-m"),
    KEY(cell.cortex.area_constant, "",
        "constant C of the skalak law, the resistance of the cortex to a change of its area; its Poisson's ratio is "
        "C / (1 + C)",
        Number{{0.01, 1000}}, 1.0, skalak),
    KEY(cell.cortex.tension_mN_per_m, "mN/m", "surface tension of the cell", Number{{0, 1e9}}, 0.0, {},
        "cell.cortex.tension_ratio"),
    KEY(cell.cortex.tension_ratio, "", "surface tension as a fraction of the modulus of the cortex", Number{{0, 1e3}},
        required, has_shell, "cell.cortex.tension_mN_per_m", "--tension-ratio"),
    KEY(cell.cortex.bending_kBT, "kBT",
        "bending stiffness c_b of the cell's surface in units of k_B T at 25 degrees C (4.116e-21 J)",
        Number{{0, 1e12}}, 0.0),

    KEY(time.scheme, "",
        "stationary: only the final shape; monolithic: its development, in implicit steps of controlled size; "
        "partitioned: its development by the splitting of Mokbel et al. 2017",
        Choice{{"stationary", "monolithic", "partitioned"}, Implied{"monolithic", "time."}}, 0),
    KEY(time.end_us, "us",
        "time for which the cell, initially a sphere, is followed; in a straight channel, or downstream of the last "
        "change of the wall, the implicit steps end as soon as its shape has settled",
        Number{{1e-6, 1e12}}, required, in_time, "time.end_um"),
    KEY(time.end_um, "um", "distance along the channel over which the cell is followed, in place of the time",
        Number{{1e-6, 1e12}}, required, in_time, "time.end_us"),
    KEY(time.output_every_us, "us", "time between measures, contours, fields and frames of the animation",
        Number{{1e-6, 1e12}}, 10.0, in_time, "time.output_every_um"),
    KEY(time.output_every_um, "um", "distance travelled by the cell between them, in place of the time",
        Number{{1e-6, 1e12}}, absent, in_time, "time.output_every_us"),
    KEY(time.accuracy, "", "requested accuracy of the positions of the surface in each step, relative to the radius",
        Number{{1e-9, 1e-2}}, 1e-5, monolithic),
    KEY(time.step_us, "us", "time step of the splitting, which is explicit in the elasticity", Number{{1e-6, 1e6}}, 0.2,
        partitioned),
    KEY(time.grid_um, "um",
        "size of the elements along the cell's surface, 0.2 in Mokbel et al. 2017; 0: the mesh of the implicit steps",
        Number{{0, 1000}}, 0.0, partitioned),
    KEY(time.start_stretch, "",
        "initial uniform stretch of the cell along the flow; its unstressed state is the sphere", Number{{0.5, 2}}, 1.0,
        monolithic),
    KEY(time.mesh_accuracy, "",
        "requested relative accuracy of the deformation as far as it depends on the mesh; mesh and degree are chosen "
        "accordingly",
        Number{{1e-6, 1e-1}}, 1e-3, monolithic, "time.degree"),
    KEY(time.degree, "",
        "polynomial degree of the spaces on a mesh of 48 or more elements, in place of the accuracy; in three "
        "dimensions at most 6",
        Number{{2, 10}, true}, absent, in_time, "time.mesh_accuracy"),

    KEY(numerics.accuracy, "", "requested relative accuracy of the deformation; mesh and degree are chosen accordingly",
        Number{{1e-7, 1e-1}}, 1e-4),
    KEY(numerics.accuracy_of, "",
        "quantity to which the accuracy refers for a cell off the axis, deformation: of its silhouette, below 1e-4 "
        "relative to 1e-4; motion: velocity, rotation, and drift or the place where the cell does not drift",
        Choice{{"deformation", "motion"}}, 0, has_offset),
};

#undef KEY
#undef FIELD

}  // namespace

std::span<const Key<Case>> case_keys() { return table; }

const Key<Case>& case_key(std::string_view name) { return *find_key(case_keys(), name); }

std::string_view chosen_option(const Case& c, std::string_view name) {
  const auto& key = case_key(name);
  return option_of(key, *key.get(c));
}

}  // namespace rheocyte
