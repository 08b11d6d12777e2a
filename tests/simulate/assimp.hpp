// Of tests that read meshes: a build may be without what reads them.
#pragma once

#include <plait/plait.h>

#include <gtest/gtest.h>

#include <string>

inline bool built_with_assimp() {
    plait_mesh* mesh = nullptr;
    (void)plait_mesh_load("nowhere.obj", nullptr, &mesh);
    return std::string(plait_last_error()).find("assimp") == std::string::npos;
}
#define SKIP_WITHOUT_ASSIMP()                                                                      \
    if (!built_with_assimp())                                                                      \
    GTEST_SKIP() << "built without assimp"
