// A client of Scarp's C library, in Rust without a crate.
use std::ffi::{c_void, CStr, CString};
use std::os::raw::c_char;
use std::ptr;

const COLS: i32 = 120;
const ROWS: i32 = 80;

#[repr(C)]
struct Field {
    struct_size: u32,
    cols: i32,
    rows: i32,
    frame: i32,
    samples: *const f32,
    nodata: f64,
    geotransform: [f64; 6],
    sample_rounding: f64,
    crs: *const c_char,
    name: *const c_char,
}

#[repr(C)]
struct Options {
    struct_size: u32,
    threads: i32,
    max_error: f64,
    max_triangles: u64,
    max_points: u64,
    mask: *const f32,
    tolerance: *const f32,
    progress: *const c_void,
    user: *mut c_void,
    named: *mut c_void,
}

#[repr(C)]
#[derive(Default)]
struct Report {
    struct_size: u32,
    stop: i32,
    effort: i32,
    is_cut_short: i32,
    max_error_col: i32,
    max_error_row: i32,
    vertices: u64,
    triangles: u64,
    samples: u64,
    uncovered: u64,
    stray: u64,
    over: u64,
    max_error: f64,
    rmse: f64,
    mean_error: f64,
    mean_abs_error: f64,
    p50: f64,
    p95: f64,
    p99: f64,
    seconds: f64,
}

#[link(name = "scarp_c")]
extern "C" {
    fn scarp_last_error() -> *const c_char;
    fn scarp_field_init(field: *mut Field, size: u32);
    fn scarp_options_init(options: *mut Options, size: u32);
    fn scarp_options_set(options: *mut Options, name: *const c_char, value: *const c_char) -> i32;
    fn scarp_options_clear(options: *mut Options);
    fn scarp_simplify(field: *const Field, options: *const Options, out: *mut *mut c_void) -> i32;
    fn scarp_measure(field: *const Field, mesh: *const c_void, options: *const Options, out: *mut Report) -> i32;
    fn scarp_mesh_vertex_count(mesh: *const c_void) -> u64;
    fn scarp_mesh_triangle_count(mesh: *const c_void) -> u64;
    fn scarp_mesh_encode(mesh: *const c_void, format: *const c_char, out: *mut *mut c_void) -> i32;
    fn scarp_mesh_free(mesh: *mut c_void);
    fn scarp_bytes_size(bytes: *const c_void) -> u64;
    fn scarp_bytes_free(bytes: *mut c_void);
    fn scarp_refiner_create(field: *const Field, out: *mut *mut c_void) -> i32;
    fn scarp_refiner_run(refiner: *mut c_void, max_error: f64, max_vertices: u64) -> i64;
    fn scarp_refiner_max_error(refiner: *const c_void) -> f64;
    fn scarp_refiner_free(refiner: *mut c_void);
}

fn last_error() -> String {
    unsafe { CStr::from_ptr(scarp_last_error()) }.to_string_lossy().into_owned()
}

fn check(status: i32) {
    if status != 0 {
        eprintln!("{}", last_error());
        std::process::exit(status);
    }
}

fn set(options: &mut Options, name: &str, value: &str) -> i32 {
    let (name, value) = (CString::new(name).unwrap(), CString::new(value).unwrap());
    unsafe { scarp_options_set(options, name.as_ptr(), value.as_ptr()) }
}

fn main() {
    let heights: Vec<f32> = (0..ROWS)
        .flat_map(|row| (0..COLS).map(move |col| ((col * col + 3 * row * row) % 97) as f32))
        .collect();
    unsafe {
        let mut field: Field = std::mem::zeroed();
        scarp_field_init(&mut field, std::mem::size_of::<Field>() as u32);
        field.samples = heights.as_ptr();
        field.cols = COLS;
        field.rows = ROWS;

        let mut options: Options = std::mem::zeroed();
        scarp_options_init(&mut options, std::mem::size_of::<Options>() as u32);
        assert_eq!(set(&mut options, "efort", "high"), 1);
        println!("{}", last_error());
        options.max_error = 5.0;
        check(set(&mut options, "effort", "normal"));

        let mut mesh = ptr::null_mut();
        check(scarp_simplify(&field, &options, &mut mesh));
        scarp_options_clear(&mut options);
        println!("{} vertices, {} triangles", scarp_mesh_vertex_count(mesh), scarp_mesh_triangle_count(mesh));

        let mut report = Report { struct_size: std::mem::size_of::<Report>() as u32, ..Default::default() };
        check(scarp_measure(&field, mesh, ptr::null(), &mut report));
        println!("max error {:.3} of {} samples", report.max_error, report.samples);

        let mut bytes = ptr::null_mut();
        let format = CString::new("glb").unwrap();
        check(scarp_mesh_encode(mesh, format.as_ptr(), &mut bytes));
        println!("{} bytes of GLB", scarp_bytes_size(bytes));
        scarp_bytes_free(bytes);
        scarp_mesh_free(mesh);

        let mut refiner = ptr::null_mut();
        check(scarp_refiner_create(&field, &mut refiner));
        let inserted = scarp_refiner_run(refiner, 20.0, 0);
        println!("{} vertices inserted, max error {:.3}", inserted, scarp_refiner_max_error(refiner));
        scarp_refiner_free(refiner);
    }
}
