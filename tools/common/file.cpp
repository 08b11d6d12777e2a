#include "common/file.hpp"
#include "common/json_reader.hpp"

#include <filesystem>
#include <fstream>

namespace common {

void write_text(const std::string& text, const std::string& path) {
    const std::string partial = path + ".part";
    std::ofstream stream(partial, std::ios::binary);
    stream << text;
    stream.close();
    std::error_code error;
    if (stream)
        std::filesystem::rename(partial, path, error);
    if (!stream || error)
        throw Failure(path + ": cannot be written");
}

std::string json_text(const Json& json) {
    return json.dump(2) + '\n';
}

void write_json(const Json& json, const std::string& path) {
    write_text(json_text(json), path);
}

void make_folder(const std::string& path) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (error)
        throw Failure(path + ": " + error.message());
}

} // namespace common
