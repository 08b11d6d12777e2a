// The extent of a dispatch: what its parameters and item count say about its buffers.
#pragma once

#include <plait/plait_backend.h>

#include <cstddef>

namespace plait::reference {

// The buffers of buffers.def.
enum class BufferName {
#define PLAIT_BUFFER(name, when, extent, components) name,
#include <plait/buffers.def>
};

class Shape {
  public:
    // Throws BadDispatch if a parameter, the item count or the item width is out of range.
    template <typename Params>
    Shape(const plait_dispatch& dispatch, plait_space space, const Params& params)
        : items_(dispatch.item_count) {
        if constexpr (requires { params.vertex_stride; })
            set_stride(params.vertex_stride);
        if constexpr (requires { params.row_stride; })
            set_row_stride(params.row_stride);
        if constexpr (requires { params.h; })
            check_positive("h", params.h);
        if constexpr (requires { params.per_root; })
            per_root_ = params.per_root != 0;
        if constexpr (requires { params.bends; })
            bends_ = params.per_root != 0 && params.bends != 0;
        if constexpr (requires { params.collider_count; })
            colliders_ = size_t{params.collider_first} + params.collider_count;
        if constexpr (requires { params.voxel_edge; })
            set_grid(params.edge_count, params.voxel_edge);
        else if constexpr (requires { params.edge_count; })
            set_grid(params.edge_count, 1);
        if constexpr (requires { params.capacity; })
            set_capacity(params.capacity);
        if constexpr (requires { params.bdf2; })
            history_ = params.bdf2 != 0;
        if constexpr (requires { params.history; })
            history_ = params.history != 0;
        if constexpr (requires { params.before; }) // of lane_orient, which else reads none of it
            history_ = params.before != 0;
        if constexpr (requires { params.accelerates; })
            accelerates_ = params.accelerates != 0;
        if constexpr (requires { params.pins; })
            pins_ = params.pins != 0;
        if constexpr (requires { params.field; })
            field_ = params.field != 0;
        if constexpr (requires { params.planes; })
            planes_ = params.planes != 0;
        if constexpr (requires { params.hollows; })
            hollows_ = params.hollows != 0;
        if constexpr (requires { params.pressure; })
            pressure_ = params.pressure != 0;
        if constexpr (requires { params.carried; })
            carried_ = params.carried != 0;
        if constexpr (requires { params.meshes; })
            meshes_ = params.meshes != 0;
        if constexpr (requires { params.wet; })
            wet_ = params.wet != 0;
        if constexpr (requires { params.shown; })
            shown_ = params.shown != 0;
        if constexpr (requires { params.boxes; })
            points_ = size_t{params.count} * (params.boxes ? 2 : 1);
        set_rows(space);
        if constexpr (requires { params.tile; })
            set_tiles(params.tile);
        if constexpr (requires { params.strand_first; })
            set_first(params.strand_first);
        if constexpr (requires { params.guide_count; })
            set_guides(params.guide_count);
        check_items(dispatch, space);
    }

    // Elements the dispatch needs of a buffer. 0: it may be null, or its size follows from the data
    // (slots name vertices) and is checked on access.
    size_t elements(BufferName buffer) const;

  private:
    void set_stride(uint32_t vertex_stride);
    void set_row_stride(uint32_t row_stride);
    void set_grid(uint32_t edge_count, double voxel_edge);
    void set_capacity(uint32_t capacity);
    void set_rows(plait_space space);
    void set_guides(size_t guides);
    void set_first(size_t strand);
    void set_tiles(size_t tile);
    void check_items(const plait_dispatch& dispatch, plait_space space) const;
    static void check_positive(const char* name, double value);

    size_t items_;
    size_t stride_ = 0;     // V, of the lanes where there are any
    size_t row_stride_ = 0; // of a strand in buffers of vertices
    size_t strands_ = 0;  // rows whose state is read or written; the guides where follows are moved
    size_t vertices_ = 0; // of those rows
    size_t followers_ = 0;
    size_t colliders_ = 0;
    size_t voxels_ = 0;
    size_t points_ = 0; // of bounds
    size_t capacity_ = 0;
    size_t tiled_vertices_ = 0; // of whole tiles of strands
    bool per_root_ = false;
    bool bends_ = false;
    bool history_ = false;
    // where the parameters do not say
    bool accelerates_ = true, pins_ = true, field_ = true, pressure_ = true, carried_ = true,
         wet_ = true, shown_ = true, meshes_ = true;
    bool planes_ = false; // mesh_field makes them, and checks on access
    bool hollows_ = false;
};

} // namespace plait::reference
