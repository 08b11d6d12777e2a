/* Hair in the vertex buffer of a renderer: shared where the driver can do that, else read to the host.
 *   08_renderer [Vulkan|D3D12|OpenGL HANDLE]: an fd of vkGetMemoryFdKHR that this process has inherited,
 *                                             a shared HANDLE, or a name of glGenBuffers */
#define CL_TARGET_OPENCL_VERSION 300
#define CL_USE_DEPRECATED_OPENCL_1_2_APIS
#include <CL/cl_ext.h>
#include <CL/cl_gl.h>
#include <plait/plait_opencl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { STRANDS = 64, PER_STRAND = 16, VERTICES = STRANDS * PER_STRAND, BYTES = 16 * VERTICES };

static void check(plait_result result) {
    if (result != PLAIT_OK)
        fprintf(stderr, "%s\n", plait_last_error()), exit(1);
}

static void check_cl(cl_int code, const char* what) {
    if (code != CL_SUCCESS)
        fprintf(stderr, "%s: OpenCL error %d\n", what, (int)code), exit(1);
}

typedef cl_int(CL_API_CALL* pass_fn)(cl_command_queue, cl_uint, const cl_mem*, cl_uint,
                                     const cl_event*, cl_event*);

/* How a renderer's buffer becomes a cl_mem, and the two calls that hand it over, each on plait's queue.
 * OpenGL's context must be given to clCreateContext, too: CL_GL_CONTEXT_KHR and its display. */
typedef struct {
    const char *renderer, *extension;
    cl_mem_properties type; /* of its handle; 0: OpenGL */
    const char *acquire, *release;
} way;
static const way ways[] = {
    {"Vulkan", "cl_khr_external_memory_opaque_fd", CL_EXTERNAL_MEMORY_HANDLE_OPAQUE_FD_KHR,
     "clEnqueueAcquireExternalMemObjectsKHR", "clEnqueueReleaseExternalMemObjectsKHR"},
    {"D3D12", "cl_khr_external_memory_d3d12_resource",
     0x2066, /* its handle: no name in every header */
     "clEnqueueAcquireExternalMemObjectsKHR", "clEnqueueReleaseExternalMemObjectsKHR"},
    {"OpenGL", "cl_khr_gl_sharing", 0, "clEnqueueAcquireGLObjects", "clEnqueueReleaseGLObjects"}};
static cl_platform_id platform;

static cl_mem import(const plait_opencl_handles* own, const way* by, cl_ulong handle) {
    cl_int code = CL_SUCCESS;
    const cl_mem_properties from[] = {by->type, handle, 0};
    cl_mem buffer =
        by->type ? clCreateBufferWithProperties(own->context, from, CL_MEM_READ_WRITE, BYTES, NULL,
                                                &code)
                 : clCreateFromGLBuffer(own->context, CL_MEM_READ_WRITE, (cl_GLuint)handle, &code);
    check_cl(code, by->renderer);
    return buffer;
}

static void pass(const plait_opencl_handles* own, const char* call, const cl_mem* buffer) {
    pass_fn function = NULL;
    *(void**)&function = clGetExtensionFunctionAddressForPlatform(platform, call);
    check_cl(function ? function(own->queue, 1, buffer, 0, NULL, NULL) : -1, call);
}

static plait_opencl_handles make_queue(void) { /* on the device that draws */
    plait_opencl_handles own = {0};
    cl_int code = CL_SUCCESS;
    check_cl(clGetPlatformIDs(1, &platform, NULL), "no platform");
    check_cl(clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, &own.device, NULL), "no device");
    own.context = clCreateContext(NULL, 1, &own.device, NULL, NULL, &code);
    own.queue = clCreateCommandQueue(own.context, own.device, 0, &code);
    check_cl(code, "clCreateContext, clCreateCommandQueue");
    return own;
}

static plait_sim* make_sim(plait_context* context) { /* the fringe of 01_hello.c */
    static float rest[VERTICES][3];
    for (int i = 0; i < VERTICES; ++i) {
        rest[i][0] = 0.003f * (float)(i / PER_STRAND);
        rest[i][2] = -0.02f * (float)(i % PER_STRAND);
    }
    plait_groom_desc desc = plait_groom_desc_defaults();
    desc.positions = (plait_view){rest, VERTICES, 0};
    desc.vertices_per_strand = PER_STRAND;
    plait_groom* groom = NULL;
    plait_sim* sim = NULL;
    check(plait_groom_create(&desc, NULL, &groom));
    check(plait_sim_create(context, groom, NULL, &sim));
    plait_groom_destroy(groom);
    return sim;
}

int main(int argc, char** argv) {
    static float mapped[VERTICES][4]; /* of an upload buffer, where nothing is shared */
    plait_opencl_handles own = make_queue();
    static char list[16384];
    check_cl(clGetDeviceInfo(own.device, CL_DEVICE_EXTENSIONS, sizeof list, list, NULL), "device");
    const way* by = NULL;
    for (size_t i = 0; i < sizeof ways / sizeof ways[0]; ++i) {
        const int can = strstr(list, ways[i].extension) != NULL;
        printf("%s: %s\n", ways[i].renderer, can ? "yes" : "no");
        by = can && argc == 3 && !strcmp(argv[1], ways[i].renderer) ? &ways[i] : by;
    }
    if (argc > 1 && !by)
        return fputs("this device does not share so\n", stderr), 1;
    cl_mem buffer = by ? import(&own, by, strtoull(argv[2], NULL, 0)) : NULL;
    plait_context* context = NULL;
    check(plait_opencl_context_create(&own, NULL, &context));
    plait_sim* sim = make_sim(context);
    for (int frame = 1; frame <= 60; ++frame) {
        check(plait_sim_step(sim, 1.0 / 60));
        if (buffer) {
            pass(&own, by->acquire, &buffer); /* the renderer has read the frame before */
            check(plait_opencl_sim_copy_field(sim, PLAIT_FIELD_POSITION, buffer, 0));
            pass(&own, by->release, &buffer); /* and waits for a semaphore, or you for clFinish */
        } else {                              /* plait_sim_read_later would not wait */
            size_t size = sizeof mapped;
            check(plait_sim_read(sim, PLAIT_FIELD_POSITION, mapped, &size));
        }
    }
    printf("%s, tip %.3f m\n", buffer ? "shared" : "through the host", (double)mapped[15][1]);
    plait_sim_destroy(sim);
    plait_context_destroy(context);
    if (buffer)
        clReleaseMemObject(buffer);
    clReleaseCommandQueue(own.queue);
    clReleaseContext(own.context);
    return 0;
}
