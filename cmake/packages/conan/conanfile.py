"""plait for Conan 2, built from the tree that this file lies in:

    conan create cmake/packages/conan --build=missing
"""

import os
import re

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load


class PlaitConan(ConanFile):
    name = "plait"
    description = "Real-time hair simulation on any OpenCL device"
    topics = ("hair", "simulation", "opencl", "graphics")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "fPIC": [True, False], "opencl": [True, False], "assimp": [True, False]}
    default_options = {"shared": True, "fPIC": True, "opencl": True, "assimp": False}
    implements = ["auto_shared_fpic"]

    @property
    def _tree(self):
        return os.path.join(self.recipe_folder, "..", "..", "..")

    def set_version(self):
        text = load(self, os.path.join(self._tree, "CMakeLists.txt"))
        self.version = re.search(r"project\(plait VERSION ([0-9.]+)", text).group(1)

    def export_sources(self):
        for part in ("CMakeLists.txt", "LICENSE", "lib/*", "cl/*", "include/*", "cmake/*", "assets/presets/*"):
            copy(self, part, self._tree, self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def requirements(self):
        self.requires("eigen/3.4.0", visible=False)  # headers, of which nothing is left in what is installed
        if self.options.opencl:
            self.requires("opencl-icd-loader/2023.12.14", transitive_headers=True)
        if self.options.assimp:
            self.requires("assimp/5.4.3")

    def generate(self):
        CMakeDeps(self).generate()
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["PLAIT_OPENCL"] = bool(self.options.opencl)
        toolchain.cache_variables["PLAIT_ASSIMP"] = bool(self.options.assimp)
        for part in ("EXAMPLES", "TOOLS", "TESTS", "BENCH"):
            toolchain.cache_variables["PLAIT_" + part] = False
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        CMake(self).install()

    def package_info(self):
        self.cpp_info.libs = ["plait"]
        self.cpp_info.set_property("cmake_file_name", "plait")
        self.cpp_info.set_property("cmake_target_name", "plait::plait")
        self.cpp_info.set_property("pkg_config_name", "plait")
        if not self.options.shared:
            self.cpp_info.defines = ["PLAIT_STATIC"]
            if self.settings.os != "Windows":
                self.cpp_info.system_libs = ["stdc++", "m"]
