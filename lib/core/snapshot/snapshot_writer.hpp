// Writes a snapshot, or counts what it takes.
#pragma once

#include "core/snapshot/snapshot_format.hpp"

#include <cstring>

namespace plait {

class SnapshotWriter {
  public:
    // `out`: null, to count, or as many bytes as were counted.
    explicit SnapshotWriter(unsigned char* out) : out_(out) {
        const SnapshotHead head = snapshots::head();
        put(&head, sizeof head);
    }

    void begin(BlockKind kind) {
        end_block();
        block_ = size_;
        const BlockHead head = snapshots::head_of(kind, 0);
        put(&head, sizeof head);
    }
    void put(const void* data, size_t bytes) {
        unsigned char* const to = room(bytes);
        if (to && bytes > 0)
            std::memcpy(to, data, bytes);
    }
    template <typename List> void put_list(const List& list) {
        put(list.data(), list.size() * sizeof list[0]);
    }
    // So many bytes are the caller's to fill; null while they are counted.
    unsigned char* room(size_t bytes) {
        unsigned char* const at = out_ ? out_ + size_ : nullptr;
        size_ += bytes;
        return at;
    }
    // How many there are in all; the last block is over.
    size_t end() {
        end_block();
        return size_;
    }

  private:
    void end_block() {
        if (!out_ || block_ == 0)
            return;
        const uint64_t bytes = size_ - block_ - sizeof(BlockHead);
        std::memcpy(out_ + block_ + offsetof(BlockHead, bytes), &bytes, sizeof bytes);
    }

    unsigned char* out_;
    size_t size_ = 0;
    size_t block_ = 0; // where it begins; 0: there is none yet
};

} // namespace plait
