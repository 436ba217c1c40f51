// A client of Scarp's C library, in Go by cgo.
package main

/*
#cgo pkg-config: scarp_c
#include <scarp_c.h>
#include <stdlib.h>
*/
import "C"

import (
	"fmt"
	"os"
	"unsafe"
)

const cols, rows = 120, 80

func lastError() string { return C.GoString(C.scarp_last_error()) }

func check(status C.scarp_status) {
	if status != C.SCARP_OK {
		fmt.Fprintln(os.Stderr, lastError())
		os.Exit(int(status))
	}
}

func set(options *C.scarp_options, name, value string) C.scarp_status {
	n, v := C.CString(name), C.CString(value)
	defer C.free(unsafe.Pointer(n))
	defer C.free(unsafe.Pointer(v))
	return C.scarp_options_set(options, n, v)
}

func main() {
	// In C's memory: Go memory that C keeps may hold no Go pointers.
	heights := (*[cols * rows]C.float)(C.malloc(cols * rows * 4))
	defer C.free(unsafe.Pointer(heights))
	for row := 0; row < rows; row++ {
		for col := 0; col < cols; col++ {
			heights[row*cols+col] = C.float((col*col + 3*row*row) % 97)
		}
	}

	var field C.scarp_field
	C.scarp_field_init(&field, C.uint32_t(unsafe.Sizeof(field)))
	field.samples = &heights[0]
	field.cols = cols
	field.rows = rows

	var options C.scarp_options
	C.scarp_options_init(&options, C.uint32_t(unsafe.Sizeof(options)))
	if set(&options, "efort", "high") != C.SCARP_USAGE {
		panic("a wrong name was taken")
	}
	fmt.Println(lastError())
	options.max_error = 5
	check(set(&options, "effort", "normal"))

	var mesh *C.scarp_mesh
	check(C.scarp_simplify(&field, &options, &mesh))
	C.scarp_options_clear(&options)
	fmt.Printf("%d vertices, %d triangles\n", C.scarp_mesh_vertex_count(mesh), C.scarp_mesh_triangle_count(mesh))

	var report C.scarp_report
	report.struct_size = C.uint32_t(unsafe.Sizeof(report))
	check(C.scarp_measure(&field, mesh, nil, &report))
	fmt.Printf("max error %.3f of %d samples\n", float64(report.max_error), uint64(report.samples))

	var bytes *C.scarp_bytes
	glb := C.CString("glb")
	defer C.free(unsafe.Pointer(glb))
	check(C.scarp_mesh_encode(mesh, glb, &bytes))
	fmt.Printf("%d bytes of GLB\n", C.scarp_bytes_size(bytes))
	C.scarp_bytes_free(bytes)
	C.scarp_mesh_free(mesh)

	var refiner *C.scarp_refiner
	check(C.scarp_refiner_create(&field, &refiner))
	inserted := C.scarp_refiner_run(refiner, 20, 0)
	fmt.Printf("%d vertices inserted, max error %.3f\n", inserted, float64(C.scarp_refiner_max_error(refiner)))
	C.scarp_refiner_free(refiner)
}
