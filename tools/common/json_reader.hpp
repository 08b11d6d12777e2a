// Strict reading of a JSON object: every value's type and range is checked, unknown keys are errors
// that name the nearest known one, and each message says where the value came from.
#pragma once

#include "common/failure.hpp"
#include "common/json_fwd.hpp"
#include "common/json_lines.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace common {

// The name in `known` with the smallest edit distance to `word`.
std::string_view nearest(std::string_view word, const std::vector<std::string>& known);
// What a key that is none may mean, for the end of a message: the nearest where that is near, else those
// that have it as a word: `; there is "strand_friction"`; "" where there are none.
std::string proposal(std::string_view word, const std::vector<std::string>& known);

// Where a document's values come from: lines of a file, or the command line.
struct Origin {
    std::string file;                   // "" if there is none
    Json command_line = Json::object(); // the part of the document that was given as options
    JsonLines lines;                    // of the file
    // "scene.json:12" or "command line" for "strand.length"; without a line where it has none
    std::string of(const std::string& path) const;
};

// One object of the document. Read every key there is, then call finish().
class JsonReader {
  public:
    JsonReader(const Json& object, const Origin& origin, std::string path = "");

    // Each leaves `target` as it is when the key is absent, and returns whether it is present.
    bool number(const char* key, float& target, double least, double most);
    bool number(const char* key, double& target, double least, double most);
    bool integer(const char* key, uint32_t& target, uint32_t least, uint32_t most);
    bool integer(const char* key, uint64_t& target);
    bool flag(const char* key, bool& target);
    bool text(const char* key, std::string& target);
    bool numbers(const char* key, std::span<float> target, double least, double most);

    // One of `names`; the target becomes its index.
    template <typename T>
    bool choice(const char* key, T& target, std::span<const char* const> names) {
        int index = static_cast<int>(target);
        const bool present = choose(key, index, names);
        target = static_cast<T>(index);
        return present;
    }

    // The value itself, for keys that hold objects or lists; null when absent.
    const Json* value(const char* key);
    JsonReader object(const Json& value, const char* key) const;
    JsonReader element(const Json& list, size_t index, const char* key) const;
    // visit(reader) for every object of a list; returns whether the key is present. `what`: of what
    // it is a list, for the message where it is none.
    template <typename Visit>
    bool each(const char* key, const Visit& visit, const char* what = "") {
        const Json* list = value(key);
        if (list && !list->is_array())
            fail(key, "is " + list->dump() + ", not a list" + what);
        for (size_t i = 0; list && i < list->size(); ++i)
            visit(element(*list, i, key));
        return list != nullptr;
    }

    void finish() const;
    [[noreturn]] void fail(const std::string& key, const std::string& problem) const;
    // "scene.json:12: pins[0].at", or of the object itself: "".
    std::string place(const std::string& key) const;

  private:
    bool choose(const char* key, int& index, std::span<const char* const> names);
    double checked(const std::string& key, const Json& value, double least, double most) const;

    const Json& object_;
    const Origin& origin_;
    std::string path_; // "params.", or "" at the top
    std::vector<std::string> known_;
};

// The document in `origin.file`, whose lines it notes. Throws Failure with file, line and column
// when it is not JSON, or with file, line and key when an object has a key twice.
Json read_json(Origin& origin);

} // namespace common
