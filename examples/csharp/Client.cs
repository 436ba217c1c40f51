// A client of Scarp's C library, in C# by P/Invoke.
using System;
using System.Globalization;
using System.Runtime.InteropServices;

static class Client
{
    const int Cols = 120, Rows = 80;
    const string Library = "scarp_c";

    [StructLayout(LayoutKind.Sequential)]
    struct Field
    {
        public uint StructSize;
        public int Cols, Rows, Frame;
        public IntPtr Samples;
        public double Nodata;
        [MarshalAs(UnmanagedType.ByValArray, SizeConst = 6)] public double[] Geotransform;
        public double SampleRounding;
        public IntPtr Crs, Name;
    }

    [StructLayout(LayoutKind.Sequential)]
    struct Options
    {
        public uint StructSize;
        public int Threads;
        public double MaxError;
        public ulong MaxTriangles, MaxPoints;
        public IntPtr Mask, Tolerance, Progress, User, Named;
    }

    [StructLayout(LayoutKind.Sequential)]
    struct Report
    {
        public uint StructSize;
        public int Stop, Effort, IsCutShort, MaxErrorCol, MaxErrorRow;
        public ulong Vertices, Triangles, Samples, Uncovered, Stray, Over;
        public double MaxError, Rmse, MeanError, MeanAbsError, P50, P95, P99, Seconds;
    }

    [DllImport(Library)] static extern IntPtr scarp_last_error();
    [DllImport(Library)] static extern void scarp_field_init(ref Field field, uint size);
    [DllImport(Library)] static extern void scarp_options_init(ref Options options, uint size);
    [DllImport(Library)] static extern int scarp_options_set(ref Options options, string name, string value);
    [DllImport(Library)] static extern void scarp_options_clear(ref Options options);
    [DllImport(Library)] static extern int scarp_simplify(ref Field field, ref Options options, out IntPtr mesh);
    [DllImport(Library)] static extern int scarp_measure(ref Field field, IntPtr mesh, IntPtr options, ref Report report);
    [DllImport(Library)] static extern ulong scarp_mesh_vertex_count(IntPtr mesh);
    [DllImport(Library)] static extern ulong scarp_mesh_triangle_count(IntPtr mesh);
    [DllImport(Library)] static extern int scarp_mesh_encode(IntPtr mesh, string format, out IntPtr bytes);
    [DllImport(Library)] static extern void scarp_mesh_free(IntPtr mesh);
    [DllImport(Library)] static extern ulong scarp_bytes_size(IntPtr bytes);
    [DllImport(Library)] static extern void scarp_bytes_free(IntPtr bytes);
    [DllImport(Library)] static extern int scarp_refiner_create(ref Field field, out IntPtr refiner);
    [DllImport(Library)] static extern long scarp_refiner_run(IntPtr refiner, double maxError, ulong maxVertices);
    [DllImport(Library)] static extern double scarp_refiner_max_error(IntPtr refiner);
    [DllImport(Library)] static extern void scarp_refiner_free(IntPtr refiner);

    static string LastError() { return Marshal.PtrToStringAnsi(scarp_last_error()); }

    static void Check(int status)
    {
        if (status == 0) return;
        Console.Error.WriteLine(LastError());
        Environment.Exit(status);
    }

    static void Main()
    {
        CultureInfo.DefaultThreadCurrentCulture = CultureInfo.CurrentCulture = CultureInfo.InvariantCulture;
        var heights = new float[Cols * Rows];
        for (int row = 0; row < Rows; ++row)
            for (int col = 0; col < Cols; ++col) heights[row * Cols + col] = (col * col + 3 * row * row) % 97;
        GCHandle pinned = GCHandle.Alloc(heights, GCHandleType.Pinned);

        var field = new Field { Geotransform = new double[6] };
        scarp_field_init(ref field, (uint)Marshal.SizeOf(typeof(Field)));
        field.Samples = pinned.AddrOfPinnedObject();
        field.Cols = Cols;
        field.Rows = Rows;

        var options = new Options();
        scarp_options_init(ref options, (uint)Marshal.SizeOf(typeof(Options)));
        if (scarp_options_set(ref options, "efort", "high") != 1) throw new Exception("a wrong name was taken");
        Console.WriteLine(LastError());
        options.MaxError = 5;
        Check(scarp_options_set(ref options, "effort", "normal"));

        IntPtr mesh;
        Check(scarp_simplify(ref field, ref options, out mesh));
        scarp_options_clear(ref options);
        Console.WriteLine("{0} vertices, {1} triangles", scarp_mesh_vertex_count(mesh), scarp_mesh_triangle_count(mesh));

        var report = new Report { StructSize = (uint)Marshal.SizeOf(typeof(Report)) };
        Check(scarp_measure(ref field, mesh, IntPtr.Zero, ref report));
        Console.WriteLine("max error {0:F3} of {1} samples", report.MaxError, report.Samples);

        IntPtr bytes;
        Check(scarp_mesh_encode(mesh, "glb", out bytes));
        Console.WriteLine("{0} bytes of GLB", scarp_bytes_size(bytes));
        scarp_bytes_free(bytes);
        scarp_mesh_free(mesh);

        IntPtr refiner;
        Check(scarp_refiner_create(ref field, out refiner));
        long inserted = scarp_refiner_run(refiner, 20, 0);
        Console.WriteLine("{0} vertices inserted, max error {1:F3}", inserted, scarp_refiner_max_error(refiner));
        scarp_refiner_free(refiner);
        pinned.Free();
    }
}
