// Real grooms, whose licences keep them out of this repository, for the tests that want one.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace plait {

// Path of the groom `name` in $PLAIT_GROOMS, by default ../shared/grooms beside the source.
inline std::string real_groom(const std::string& name) {
    const char* given = std::getenv("PLAIT_GROOMS");
    const std::string folder = given ? given : PLAIT_SOURCE_DIR "/../shared/grooms";
    return folder + "/" + name;
}

// In a test's body: it is skipped where the file is not there, and says so.
#define PLAIT_SKIP_WITHOUT(path)                                                                   \
    if (!std::filesystem::exists(path))                                                            \
    GTEST_SKIP() << "there is no " << (path) << " (PLAIT_GROOMS names the folder)"

} // namespace plait
