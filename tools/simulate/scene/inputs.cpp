#include "inputs.hpp"

#include "checksum.hpp"
#include "common/json_reader.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

namespace simulate {

namespace {

constexpr const char* no_inputs[] = {"out",     "json",          "trace", "device",
                                     "backend", "restart_every", "resume"};
constexpr size_t most_letters = 60; // of a value, in a message

uint64_t checksum_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::vector<char> block(size_t{1} << 20);
    Checksum sum;
    while (stream.read(block.data(), static_cast<std::streamsize>(block.size())) ||
           stream.gcount() > 0)
        sum.add(block.data(), static_cast<size_t>(stream.gcount()));
    return sum.value();
}

// Every text that is a file's path, by its place in the document.
void add_files(const Json& value, const std::string& place, const std::filesystem::path& folder,
               Json& files) {
    if (value.is_structured())
        for (const auto& [key, inner] : value.items())
            add_files(inner, place + (value.is_array() ? "[" + key + "]" : "." + key), folder,
                      files);
    if (!value.is_string())
        return;
    const std::filesystem::path file = folder / value.get<std::string>();
    std::error_code error;
    if (std::filesystem::is_regular_file(file, error))
        files[place] = checksum_of(file);
}

std::string in_words(const Json* value) {
    if (!value)
        return "not given";
    const std::string text = value->dump(-1, ' ', false, Json::error_handler_t::replace);
    return text.size() <= most_letters ? text : text.substr(0, most_letters) + "...";
}

const Json* find(const Json& object, const std::string& key) {
    const auto at = object.find(key);
    return at == object.end() ? nullptr : &*at;
}

template <typename See> void for_each_key(const Json& was, const Json& is, const See& see) {
    std::set<std::string> keys;
    for (const Json* object : {&was, &is})
        for (const auto& item : object->items())
            keys.insert(item.key());
    for (const std::string& key : keys)
        see(key, find(was, key), find(is, key));
}

void compare(const Json& was, const Json& is, const std::string& place,
             std::vector<std::string>& found) {
    for_each_key(was, is, [&](const std::string& key, const Json* before, const Json* now) {
        if (before && now && before->is_object() && now->is_object())
            compare(*before, *now, place + key + ".", found);
        else if (!before || !now || *before != *now)
            found.push_back(place + key + " is " + in_words(now) + ", was " + in_words(before));
    });
}

} // namespace

std::string inputs_of(const Json& document, const Origin& origin) {
    Json keys = document, files = Json::object();
    for (const char* key : no_inputs)
        keys.erase(key);
    for (const auto& [key, value] : keys.items()) {
        const bool beside_file = !origin.command_line.contains(key);
        if (key != "cache") // which the run writes
            add_files(value, key,
                      beside_file ? std::filesystem::path(origin.file).parent_path() : "", files);
    }
    return Json{{"program", PROGRAM_VERSION}, {"keys", keys}, {"files", files}}.dump(
        -1, ' ', false, Json::error_handler_t::replace);
}

std::vector<std::string> differences(const Json& was, const Json& is) {
    std::vector<std::string> found;
    if (was.at("program") != is.at("program"))
        found.push_back("plait-simulate is " + in_words(&is.at("program")) + ", was " +
                        in_words(&was.at("program")));
    compare(was.at("keys"), is.at("keys"), "", found);
    for_each_key(was.at("files"), is.at("files"),
                 [&](const std::string& place, const Json* before, const Json* now) {
                     if (before && now && *before != *now)
                         found.push_back("what the file of " + place + " holds is another");
                 });
    return found;
}

} // namespace simulate
