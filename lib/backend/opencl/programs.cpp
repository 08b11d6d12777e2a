#include "backend/opencl/programs.hpp"

#include "backend/opencl/errors.hpp"
#include "base/format.hpp"
#include "base/hash.hpp"
#include "base/path.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

namespace plait::opencl {
namespace {

constexpr char magic[] = "plait program 1\n";

uint64_t hash_of(const std::string& text) {
    Hash hash;
    hash.add(text.data(), text.size());
    return hash.value();
}

// The devices' programs that anyone holds.
struct Registry {
    std::mutex mutex;
    std::map<cl_device_id, std::weak_ptr<Programs>> list;
};

Registry& registry() {
    static Registry instance;
    return instance;
}

std::string build_log(cl_program program, cl_device_id device) {
    size_t size = 0;
    clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, 0, nullptr, &size);
    std::string text(size, '\0');
    clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, size, text.data(), nullptr);
    text.resize(std::strlen(text.c_str()));
    while (!text.empty() && (text.back() == '\n' || text.back() == ' '))
        text.pop_back();
    return text;
}

Result<Program> build_source(cl_context context, const ProgramRequest& request) {
    const char* text = request.source.text.c_str();
    const char* file = request.source.files[0].c_str();
    const cl_device_id device = request.device.device;
    cl_int code = CL_SUCCESS;
    Program program(clCreateProgramWithSource(context, 1, &text, nullptr, &code));
    if (code != CL_SUCCESS)
        return failure(code, "clCreateProgramWithSource");
    code = clBuildProgram(program.get(), 1, &device, request.options.c_str(), nullptr, nullptr);
    const std::string messages = with_true_lines(request.source, build_log(program.get(), device));
    if (code != CL_SUCCESS)
        return Error{PLAIT_COMPILE, format("%s did not build on %s with %s: %s\n%s", file,
                                           request.device.info.name, request.options.c_str(),
                                           error_name(code).c_str(), messages.c_str())};
    if (!messages.empty())
        request.log(PLAIT_LOG_LEVEL_DEBUG, format("%s: %s", file, messages.c_str()));
    return program;
}

// None where the driver does not take it: it is then built from its source.
Program build_binary(cl_context context, const ProgramRequest& request, const std::string& binary) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(binary.data());
    const size_t size = binary.size();
    const cl_device_id device = request.device.device;
    cl_int status = CL_SUCCESS, code = CL_SUCCESS;
    Program program(clCreateProgramWithBinary(context, 1, &device, &size, &bytes, &status, &code));
    if (code == CL_SUCCESS && status == CL_SUCCESS)
        code = clBuildProgram(program.get(), 1, &device, request.options.c_str(), nullptr, nullptr);
    if (code == CL_SUCCESS && status == CL_SUCCESS)
        return program;
    request.log(PLAIT_LOG_LEVEL_INFO,
                format("%s: the driver does not take the program that it gave before (%s): built "
                       "anew",
                       request.source.files[0].c_str(), error_name(code).c_str()));
    return {};
}

// Of a program for one device, or of one among the context's; "" if the driver gives none.
std::string binary_of(cl_program program, cl_device_id device) {
    cl_uint count = 0;
    clGetProgramInfo(program, CL_PROGRAM_NUM_DEVICES, sizeof count, &count, nullptr);
    std::vector<cl_device_id> devices(count);
    std::vector<size_t> sizes(count);
    clGetProgramInfo(program, CL_PROGRAM_DEVICES, count * sizeof(cl_device_id), devices.data(),
                     nullptr);
    if (clGetProgramInfo(program, CL_PROGRAM_BINARY_SIZES, count * sizeof(size_t), sizes.data(),
                         nullptr) != CL_SUCCESS)
        return {};
    std::string binary;
    std::vector<unsigned char*> to(count, nullptr);
    for (cl_uint i = 0; i < count; ++i)
        if (devices[i] == device) {
            binary.resize(sizes[i]);
            to[i] = reinterpret_cast<unsigned char*>(binary.data());
        }
    if (clGetProgramInfo(program, CL_PROGRAM_BINARIES, count * sizeof(unsigned char*), to.data(),
                         nullptr) != CL_SUCCESS)
        return {};
    return binary;
}

// All that decides what comes of a source.
std::string key_of(const ProgramRequest& request) {
    const plait_device_info& info = request.device.info;
    return format("%s\n%s\n%s\n%s\n%s\n%s\n", request.source.files[0].c_str(), info.platform,
                  info.name, info.vendor, info.driver, request.options.c_str()) +
           request.source.text;
}

} // namespace

Result<ProgramFolder> ProgramFolder::open(const char* path) {
    std::error_code failed;
    std::filesystem::create_directories(native_path(path), failed);
    if (failed || !std::filesystem::is_directory(native_path(path), failed))
        return Error{PLAIT_IO, format("program_folder %s: %s", path,
                                      failed ? failed.message().c_str() : "it is no folder")};
    ProgramFolder folder;
    folder.path_ = path;
    return folder;
}

std::string ProgramFolder::file_of(const std::string& key) const {
    return format("%s/%016llx.program", path_.c_str(),
                  static_cast<unsigned long long>(hash_of(key)));
}

void ProgramFolder::remove(const std::string& key) const {
    std::error_code failed;
    std::filesystem::remove(native_path(file_of(key)), failed);
}

std::string ProgramFolder::load(const std::string& key, const Log& log) const {
    const std::string path = path_.empty() ? "" : file_of(key);
    std::ifstream file(native_path(path), std::ios::binary);
    if (path.empty() || !file)
        return {};
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    const std::string head = magic + key;
    uint64_t checksum = 0;
    const size_t begin = head.size() + sizeof checksum;
    if (bytes.size() > begin && bytes.compare(0, head.size(), head) == 0) {
        std::memcpy(&checksum, bytes.data() + head.size(), sizeof checksum);
        const std::string binary = bytes.substr(begin);
        if (checksum == hash_of(binary))
            return binary;
    }
    file.close();
    remove(key);
    log(PLAIT_LOG_LEVEL_WARNING, path + ": damaged, or of another program: built anew");
    return {};
}

// Written aside and renamed, for processes that start together.
void ProgramFolder::save(const std::string& key, const std::string& binary, const Log& log) const {
    if (path_.empty() || binary.empty())
        return;
    const std::string path = file_of(key), aside = path + format(".%08x", std::random_device{}());
    const uint64_t checksum = hash_of(binary);
    std::error_code failed;
    const size_t size = std::strlen(magic) + key.size() + sizeof checksum + binary.size();
    if (std::filesystem::file_size(native_path(path), failed) == size && !failed)
        return;
    std::ofstream file(native_path(aside), std::ios::binary);
    file << magic << key;
    file.write(reinterpret_cast<const char*>(&checksum), sizeof checksum);
    file << binary;
    file.close();
    failed.clear();
    if (file)
        std::filesystem::rename(native_path(aside), native_path(path), failed);
    if (file && !failed)
        return;
    log(PLAIT_LOG_LEVEL_WARNING, path + ": " + (failed ? failed.message() : std::strerror(errno)) +
                                     ": the program is not kept");
    std::filesystem::remove(native_path(aside), failed);
}

Result<std::shared_ptr<Programs>> Programs::of_device(const Candidate& device) {
    const std::scoped_lock lock(registry().mutex);
    std::weak_ptr<Programs>& place = registry().list[device.device];
    if (auto found = place.lock())
        return found;
    const cl_context_properties properties[] = {
        CL_CONTEXT_PLATFORM, reinterpret_cast<cl_context_properties>(device.platform), 0};
    cl_int code = CL_SUCCESS;
    Context context(clCreateContext(properties, 1, &device.device, nullptr, nullptr, &code));
    if (code != CL_SUCCESS)
        return failure(code, format("clCreateContext on %s", device.info.name));
    auto made = std::make_shared<Programs>(std::move(context));
    place = made;
    return made;
}

void Programs::abandon() {
    const std::scoped_lock lock(registry().mutex);
    std::erase_if(registry().list,
                  [this](const auto& entry) { return entry.second.lock().get() == this; });
}

Result<BuiltProgram> Programs::get(const ProgramRequest& request) {
    const std::string key = key_of(request);
    const std::scoped_lock lock(mutex_);
    if (const auto found = built_.find(key); found != built_.end())
        return found->second;
    BuiltProgram built{{}, key, false, true};
    if (const std::string binary = request.folder.load(key, request.log); !binary.empty()) {
        built.program = build_binary(context(), request, binary);
        if (!built.program)
            request.folder.remove(key);
    }
    built.from_binary = static_cast<bool>(built.program);
    if (!built.program) {
        auto program = build_source(context(), request);
        PLAIT_TRY(program);
        built.program = std::move(*program);
    }
    built_.emplace(key, BuiltProgram{built.program, key, built.from_binary, false});
    return built;
}

void keep_program(const ProgramFolder& folder, const std::string& key, cl_program program,
                  cl_device_id device, const Log& log) {
    if (folder)
        folder.save(key, binary_of(program, device), log);
}

} // namespace plait::opencl
