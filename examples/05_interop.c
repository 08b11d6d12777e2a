/* Positions stay on the device: plait works in your OpenCL context and on your queue, a kernel of
 * yours reads plait's buffer there, and one number comes back. Links OpenCL beside plait. */
#include <math.h>
#include <plait/plait_opencl.h>
#include <stdio.h>
#include <stdlib.h>

enum { STRANDS = 64, PER_STRAND = 16, VERTICES = STRANDS * PER_STRAND };

/* The farthest that a vertex went, m. Floats from 0 on are in the order of their bits. */
static const char* source = "__kernel void farthest(__global const float4* before,"
                            "                       __global const float4* now,"
                            "                       __global int* most) {"
                            "    const size_t i = get_global_id(0);"
                            "    atomic_max(most, as_int(distance(before[i].xyz, now[i].xyz)));"
                            "}";

static void check(plait_result result) {
    if (result == PLAIT_OK)
        return;
    fprintf(stderr, "%s\n", plait_last_error());
    exit(1);
}

static void check_cl(cl_int code, const char* what) {
    if (code == CL_SUCCESS)
        return;
    fprintf(stderr, "%s: OpenCL error %d\n", what, (int)code);
    exit(1);
}

/* What an application that draws has already: a device, a context, an in-order queue. */
static plait_opencl_handles make_queue(void) {
    plait_opencl_handles own = {0};
    cl_platform_id platforms[8];
    cl_uint count = 0;
    cl_int code = clGetPlatformIDs(8, platforms, &count);
    for (cl_uint i = 0; i < count && i < 8 && !own.device; ++i)
        code = clGetDeviceIDs(platforms[i], CL_DEVICE_TYPE_ALL, 1, &own.device, NULL);
    check_cl(own.device ? CL_SUCCESS : code, "no device");
    own.context = clCreateContext(NULL, 1, &own.device, NULL, NULL, &code);
    check_cl(code, "clCreateContext");
    own.queue = clCreateCommandQueue(own.context, own.device, 0, &code);
    check_cl(code, "clCreateCommandQueue");
    return own;
}

static cl_kernel make_kernel(const plait_opencl_handles* own) {
    cl_int code = CL_SUCCESS;
    cl_program program = clCreateProgramWithSource(own->context, 1, &source, NULL, &code);
    check_cl(code, "clCreateProgramWithSource");
    check_cl(clBuildProgram(program, 1, &own->device, "", NULL, NULL), "clBuildProgram");
    cl_kernel kernel = clCreateKernel(program, "farthest", &code);
    check_cl(code, "clCreateKernel");
    clReleaseProgram(program); /* the kernel keeps it */
    return kernel;
}

/* The fringe of 01_hello.c. */
static plait_sim* make_sim(plait_context* context) {
    static float rest[VERTICES][3];
    for (int i = 0; i < VERTICES; ++i) {
        rest[i][0] = 0.003f * (float)(i / PER_STRAND) - 0.0945f;
        rest[i][1] = -0.02f * (float)(i % PER_STRAND);
    }
    plait_groom_desc desc = plait_groom_desc_defaults();
    desc.positions = (plait_view){rest, VERTICES, 0};
    desc.vertices_per_strand = PER_STRAND;
    plait_groom* groom = NULL;
    plait_sim* sim = NULL;
    check(plait_groom_create(&desc, NULL, &groom));
    check(plait_sim_create(context, groom, NULL, &sim));
    plait_groom_destroy(groom); /* the sim keeps what it needs of it */
    return sim;
}

int main(void) {
    plait_opencl_handles own = make_queue();
    plait_context* context = NULL;
    check(plait_opencl_context_create(&own, NULL, &context)); /* retains the three handles */
    plait_sim* sim = make_sim(context);

    cl_mem now = NULL; /* plait's, borrowed: good until the sim is destroyed, and not released */
    check(plait_opencl_sim_get_field(sim, PLAIT_FIELD_POSITION, &now));
    cl_int code = CL_SUCCESS;
    const size_t bytes = VERTICES * sizeof(cl_float4); /* as plait_sim_read would say */
    cl_mem before = clCreateBuffer(own.context, CL_MEM_READ_WRITE, bytes, NULL, &code);
    check_cl(code, "clCreateBuffer");
    cl_float farthest = 0;
    cl_mem most =
        clCreateBuffer(own.context, CL_MEM_COPY_HOST_PTR, sizeof farthest, &farthest, &code);
    check_cl(code, "clCreateBuffer");
    cl_kernel kernel = make_kernel(&own);
    const cl_mem arguments[] = {before, now, most};
    for (cl_uint i = 0; i < 3; ++i)
        check_cl(clSetKernelArg(kernel, i, sizeof(cl_mem), &arguments[i]), "clSetKernelArg");

    plait_roots roots = plait_roots_defaults();
    const size_t items = VERTICES;
    for (int frame = 1; frame <= 120; ++frame) { /* one queue, in order: nothing here waits */
        const float half = 0.3f * sinf(6.2831853f * (float)frame / 60);
        roots.head = (plait_pose){.q = {0, sinf(half), 0, cosf(half)}};
        check(plait_opencl_sim_copy_field(sim, PLAIT_FIELD_POSITION, before, 0));
        check(plait_sim_set_roots(sim, &roots));
        check(plait_sim_step(sim, 1.0 / 60));
        code = clEnqueueNDRangeKernel(own.queue, kernel, 1, NULL, &items, NULL, 0, NULL, NULL);
        check_cl(code, "clEnqueueNDRangeKernel");
    }
    code =
        clEnqueueReadBuffer(own.queue, most, CL_TRUE, 0, sizeof farthest, &farthest, 0, NULL, NULL);
    check_cl(code, "clEnqueueReadBuffer"); /* the one that waits */
    printf("the fastest vertex went %.3f m/s\n", 60 * (double)farthest);

    plait_sim_destroy(sim);
    plait_context_destroy(context);
    clReleaseKernel(kernel);
    clReleaseMemObject(before);
    clReleaseMemObject(most);
    clReleaseCommandQueue(own.queue);
    clReleaseContext(own.context);
    return 0;
}
