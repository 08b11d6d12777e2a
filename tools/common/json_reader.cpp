#include "common/json_reader.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>

namespace common {

namespace {

size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), size_t{0});
    for (size_t i = 0; i < a.size(); ++i) {
        size_t diagonal = std::exchange(row[0], i + 1);
        for (size_t j = 0; j < b.size(); ++j) {
            const size_t replaced = diagonal + (a[i] != b[j]);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
        }
    }
    return row.back();
}

// "[least, most]"
template <typename T> std::string range(T least, T most) {
    return Json{least, most}.dump();
}

} // namespace

std::string_view nearest(std::string_view word, const std::vector<std::string>& known) {
    return *std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
        return edit_distance(word, a) < edit_distance(word, b);
    });
}

std::string proposal(std::string_view word, const std::vector<std::string>& known) {
    if (known.empty())
        return "";
    if (const std::string_view near = nearest(word, known);
        edit_distance(word, near) <= std::max<size_t>(1, word.size() / 3))
        return "; the nearest is \"" + std::string(near) + "\"";
    std::string with;
    for (const std::string& key : known)
        if (key.starts_with(std::string(word) + '_') ||
            key.ends_with(std::string("_").append(word)))
            with += (with.empty() ? "; there is \"" : ", \"") + key + "\"";
    return with;
}

std::string Origin::of(const std::string& path) const {
    const Json* given = &command_line;
    for (size_t from = 0; given && from <= path.size();) {
        const size_t dot = std::min(path.find('.', from), path.size());
        const auto found =
            given->is_object() ? given->find(path.substr(from, dot - from)) : given->end();
        given = found == given->end() ? nullptr : &*found;
        from = dot + 1;
    }
    if (file.empty() || (given && !path.empty()))
        return "command line";
    for (std::string known = path; !known.empty();) { // of the nearest that has one
        if (const auto line = lines.find(known); line != lines.end())
            return file + ":" + std::to_string(line->second);
        const size_t end = known.find_last_of(".[");
        known.resize(end == std::string::npos ? 0 : end);
    }
    return file;
}

JsonReader::JsonReader(const Json& object, const Origin& origin, std::string path)
    : object_(object), origin_(origin), path_(std::move(path)) {
    if (!object.is_object())
        fail("", "is " + object.dump() + ", not an object in braces");
}

std::string JsonReader::place(const std::string& key) const {
    std::string whole = path_ + key;
    if (key.empty() && !whole.empty())
        whole.pop_back(); // the dot
    return origin_.of(whole) + ": " + (whole.empty() ? "the document" : whole);
}

void JsonReader::fail(const std::string& key, const std::string& problem) const {
    throw Failure(place(key) + " " + problem);
}

const Json* JsonReader::value(const char* key) {
    known_.emplace_back(key);
    const auto found = object_.find(key);
    return found == object_.end() ? nullptr : &*found;
}

double JsonReader::checked(const std::string& key, const Json& value, double least,
                           double most) const {
    if (!value.is_number())
        fail(key, "is " + value.dump() + ", not a number");
    const double number = value.get<double>();
    if (!(number >= least && number <= most))
        fail(key, "is " + value.dump() + ", outside " + range(least, most));
    return number;
}

bool JsonReader::number(const char* key, double& target, double least, double most) {
    const Json* found = value(key);
    if (found)
        target = checked(key, *found, least, most);
    return found;
}

bool JsonReader::number(const char* key, float& target, double least, double most) {
    double wide = static_cast<double>(target);
    const bool present = number(key, wide, least, most);
    target = static_cast<float>(wide);
    return present;
}

bool JsonReader::integer(const char* key, uint32_t& target, uint32_t least, uint32_t most) {
    const Json* found = value(key);
    if (!found)
        return false;
    if (!found->is_number_integer())
        fail(key, "is " + found->dump() + ", not a whole number");
    if (const auto number = found->get<int64_t>(); number < least || number > most)
        fail(key, "is " + found->dump() + ", outside " + range(least, most));
    target = found->get<uint32_t>();
    return true;
}

bool JsonReader::integer(const char* key, uint64_t& target) {
    const Json* found = value(key);
    if (!found)
        return false;
    if (!found->is_number_unsigned())
        fail(key, "is " + found->dump() + ", not a whole number of at least 0");
    target = found->get<uint64_t>();
    return true;
}

bool JsonReader::flag(const char* key, bool& target) {
    const Json* found = value(key);
    if (found && !found->is_boolean())
        fail(key, "is " + found->dump() + ", neither true nor false");
    if (found)
        target = found->get<bool>();
    return found;
}

bool JsonReader::text(const char* key, std::string& target) {
    const Json* found = value(key);
    if (found && !found->is_string())
        fail(key, "is " + found->dump() + ", not a string");
    if (found)
        target = found->get<std::string>();
    return found;
}

bool JsonReader::numbers(const char* key, std::span<float> target, double least, double most) {
    const Json* found = value(key);
    if (!found)
        return false;
    if (!found->is_array() || found->size() != target.size())
        fail(key, "is " + found->dump() + ", not a list of " + std::to_string(target.size()) +
                      " numbers");
    for (size_t i = 0; i < target.size(); ++i)
        target[i] = static_cast<float>(
            checked(std::string(key) + "[" + std::to_string(i) + "]", (*found)[i], least, most));
    return true;
}

bool JsonReader::choose(const char* key, int& index, std::span<const char* const> names) {
    std::string word;
    if (!text(key, word))
        return false;
    const auto found = std::find(names.begin(), names.end(), word);
    if (found == names.end()) {
        std::string list;
        for (const char* name : names)
            list += (list.empty() ? "" : ", ") + std::string(name);
        fail(key, "is \"" + word + "\", not one of " + list);
    }
    index = static_cast<int>(found - names.begin());
    return true;
}

JsonReader JsonReader::object(const Json& value, const char* key) const {
    return JsonReader(value, origin_, path_ + key + ".");
}

JsonReader JsonReader::element(const Json& list, size_t index, const char* key) const {
    return JsonReader(list[index], origin_, path_ + key + "[" + std::to_string(index) + "].");
}

void JsonReader::finish() const {
    for (const auto& [key, value] : object_.items())
        if (std::find(known_.begin(), known_.end(), key) == known_.end())
            fail(key, "is no known key" + proposal(key, known_));
}

// Levels; no scene has ten.
constexpr int deepest = 100;

Json read_json(Origin& origin) {
    std::ifstream stream(origin.file);
    if (!stream || std::filesystem::is_directory(origin.file))
        throw Failure(origin.file + ": cannot be opened");
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    try {
        const auto check = [&](int depth, Json::parse_event_t, const Json& value) {
            if (depth > deepest)
                throw Failure(origin.file + ": is nested more than " + std::to_string(deepest) +
                              " deep");
            if (value.is_string() &&
                value.get_ref<const std::string&>().find('\0') != std::string::npos)
                throw Failure(origin.file + ": " + value.dump() +
                              " has the character 0, which would end a file's name");
            return true;
        };
        Json document = Json::parse(text, check, true, true); // comments are welcome
        std::vector<DuplicateKey> duplicates;
        origin.lines = find_lines(text, duplicates);
        if (!duplicates.empty()) // the parser keeps the last and says nothing
            throw Failure(origin.file + ":" + std::to_string(duplicates[0].line) + ": " +
                          duplicates[0].path + " stands here again, after line " +
                          std::to_string(duplicates[0].first));
        return document;
    } catch (const Json::exception& error) { // of syntax, or of a number beyond all
        throw Failure(origin.file + ": " + error.what());
    }
}

} // namespace common
