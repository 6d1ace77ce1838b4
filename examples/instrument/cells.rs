// Moduli of single cells by the C interface: rustc -L FOLDER cells.rs && LD_LIBRARY_PATH=FOLDER ./cells
use std::ffi::CStr;
use std::os::raw::{c_char, c_double};
use std::ptr::{null, null_mut};

const ABI: u32 = 1;
const WIDTH: u32 = 250;
const HEIGHT: u32 = 80;

#[repr(C)]
pub struct Setup {
    _private: [u8; 0],
}
#[repr(C)]
pub struct Worker {
    _private: [u8; 0],
}

#[repr(C)]
#[derive(Default)]
pub struct Cell {
    area_um2: c_double,
    deformation: c_double,
    inertia_ratio: c_double,
    x_um: c_double,
    y_um: c_double,
    young_modulus_kpa: c_double,
    young_modulus_error_kpa: c_double,
    effective_modulus_kpa: c_double,
    effective_modulus_error_kpa: c_double,
    stiffness_kpa: c_double,
    stiffness_error_kpa: c_double,
    axial_tension_pa: c_double,
    young_state: i32,
    effective_state: i32,
    outline: i32,
    setup: u32,
}

#[link(name = "rheocyte_cell")]
extern "C" {
    fn rheocyte_cell_open_values(
        abi: u32, medium: *const c_char, temperature_c: c_double, viscosity_mpas: c_double, channel_width_um: c_double,
        flow_rate_ul_s: c_double, pixel_size_um: c_double, axial_tension_pa: c_double, tables_folder: *const c_char,
        setup: *mut *mut Setup, message: *mut c_char, message_bytes: usize,
    ) -> i32;
    fn rheocyte_cell_open_worker(
        setup: *mut Setup, most_width: u32, most_height: u32, remembered: u32, worker: *mut *mut Worker,
    ) -> i32;
    fn rheocyte_cell_from_mask(
        worker: *mut Worker, pixels: *const u8, width: u32, height: u32, row_bytes: usize, result: *mut Cell,
    ) -> i32;
    fn rheocyte_cell_close_worker(worker: *mut Worker) -> i32;
    fn rheocyte_cell_close(setup: *mut Setup) -> i32;
}

fn mask() -> Vec<u8> {
    let inside = |x: u32, y: u32| {
        ((f64::from(x) - 125.0) / 21.0).powi(2) + ((f64::from(y) - 40.0) / 18.0).powi(2) <= 1.0
    };
    (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| u8::from(inside(x, y)))).collect()
}

fn main() {
    let mut setup: *mut Setup = null_mut();
    let mut worker: *mut Worker = null_mut();
    let mut message = [0 as c_char; 500];
    let mut cell = Cell::default();
    let pixels = mask();
    unsafe {
        let status = rheocyte_cell_open_values(
            ABI, b"CellCarrier\0".as_ptr().cast(), 23.0, f64::NAN, 20.0, 0.04, 0.34, 200.0, null(), &mut setup,
            message.as_mut_ptr(), message.len(),
        );
        assert_eq!(status, 0, "{}", CStr::from_ptr(message.as_ptr()).to_string_lossy());
        assert_eq!(rheocyte_cell_open_worker(setup, WIDTH, HEIGHT, 0, &mut worker), 0);
        assert_eq!(rheocyte_cell_from_mask(worker, pixels.as_ptr(), WIDTH, HEIGHT, 0, &mut cell), 0);
        assert_eq!(rheocyte_cell_close_worker(worker), 0);
        assert_eq!(rheocyte_cell_close(setup), 0);
    }
    println!(
        "area {:?} deformation {:?} E {:?} S {:?}",
        cell.area_um2, cell.deformation, cell.young_modulus_kpa, cell.stiffness_kpa
    );
}
