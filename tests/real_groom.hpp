// Real grooms, whose licences keep them out of this repository, for the tests that want one.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace plait {

// Path of the groom `name` in $PLAIT_GROOMS, by default ../shared/grooms beside the source; ""
// where there is none, after saying so: the test is then to leave.
inline std::string real_groom(const std::string& name) {
    const char* given = std::getenv("PLAIT_GROOMS");
    const std::string folder = given ? given : PLAIT_SOURCE_DIR "/../shared/grooms";
    if (std::filesystem::exists(folder + "/" + name))
        return folder + "/" + name;
    std::printf("without %s: not in %s\n", name.c_str(), folder.c_str());
    return "";
}

} // namespace plait
