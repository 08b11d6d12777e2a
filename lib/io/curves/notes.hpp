// What a reader took from a file, and what of it it did not, in sentences.
#pragma once

#include "base/format.hpp"
#include "io/words.hpp"

#include <cinttypes>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace plait {

// Names of things of one kind, each once; of more than a few only the number is kept.
class Names {
  public:
    void add(std::string_view name) {
        ++count_;
        const std::string kept = shown(name);
        for (const std::string& other : names_)
            if (other == kept)
                return;
        if (names_.size() < MOST)
            names_.push_back(kept);
        else
            more_ = true;
    }
    uint64_t count() const { return count_; }
    std::string list() const {
        std::string text;
        for (const std::string& name : names_)
            text += (text.empty() ? "" : ", ") + name;
        return more_ ? text + ", ..." : text;
    }

  private:
    static constexpr size_t MOST = 8;
    std::vector<std::string> names_;
    uint64_t count_ = 0;
    bool more_ = false;
};

class Notes {
  public:
    void add(const std::string& sentence) { text_ += (text_.empty() ? "" : "; ") + sentence; }
    // "3 properties are not used: a, b", unless there are none.
    void add(const char* what, const Names& names) {
        if (names.count() > 0)
            add(format("%" PRIu64 " %s: %s", names.count(), what, names.list().c_str()));
    }
    std::string take() { return std::move(text_); }

  private:
    std::string text_;
};

} // namespace plait
