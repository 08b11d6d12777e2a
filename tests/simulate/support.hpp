// A folder of its own for each test, gone when the test is; and what a refusal says.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string>

class TemporaryFolder : public testing::Test {
  protected:
    void SetUp() override {
        const std::string name = "plait-" + std::to_string(std::random_device{}());
        folder_ = (std::filesystem::temp_directory_path() / name).string();
        ASSERT_TRUE(std::filesystem::create_directory(folder_));
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::string path(const std::string& name) const {
        return (std::filesystem::path(folder_) / name).string();
    }

    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(path(name)) << text;
        return path(name);
    }

  private:
    std::string folder_;
};

template <typename Attempt> std::string refusal_of(const Attempt& attempt) {
    try {
        attempt();
    } catch (const std::runtime_error& failure) {
        return failure.what();
    }
    return "no refusal";
}
