// Programs of one device, built once: by every plait context on it, and kept in a folder where the
// caller names one.
#pragma once

#include "backend/opencl/enumerate.hpp"
#include "backend/opencl/source.hpp"
#include "base/log.hpp"
#include "base/result.hpp"

#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace plait::opencl {

// Binaries of programs, a file each, for the processes that come later. A file holds a checksum and
// the whole key that it was written under, so that what is damaged or of another driver is not
// used.
class ProgramFolder {
  public:
    ProgramFolder() = default; // none
    // Makes the folder where it is not there. @errors IO: names it
    static Result<ProgramFolder> open(const char* path);

    // "" where there is none; what is there and cannot be used is said to the log, and removed.
    std::string load(const std::string& key, const Log& log) const;
    void remove(const std::string& key) const;
    // Unless it has one of that size: a driver adds to a program what it compiles when a kernel runs.
    void save(const std::string& key, const std::string& binary, const Log& log) const;

    explicit operator bool() const { return !path_.empty(); }

  private:
    std::string file_of(const std::string& key) const;
    std::string path_;
};

// Where a program is to be had from and what its making is told to.
struct ProgramRequest {
    const Candidate& device;
    const Source& source;
    const std::string& options;
    const ProgramFolder& folder;
    const Log& log;
};

struct BuiltProgram {
    Program program;
    std::string key;  // in a folder
    bool from_binary; // whose source was held to its stage's signature before it was kept
    bool is_new;      // nobody had it in this process
};

// Threads: any; one program is built at a time.
class Programs {
  public:
    explicit Programs(Context context) : context_(std::move(context)) {}

    // The device's, shared by all that hold them; made where nobody does. @errors BACKEND
    static Result<std::shared_ptr<Programs>> of_device(const Candidate& device);
    // No longer handed out: the device is lost, and with it what was built.
    void abandon();

    cl_context context() const { return context_.get(); }
    // @errors COMPILE with the compiler's whole log
    Result<BuiltProgram> get(const ProgramRequest& request);

  private:
    Context context_;
    std::mutex mutex_;
    std::map<std::string, BuiltProgram> built_; // by key
};

// Into the folder, if there is one, as the driver has it by now.
void keep_program(const ProgramFolder& folder, const std::string& key, cl_program program,
                  cl_device_id device, const Log& log);

} // namespace plait::opencl
