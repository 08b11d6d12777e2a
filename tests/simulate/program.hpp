// plait-simulate, started as a user starts it.
#pragma once

#include "support.hpp"

#include <nlohmann/json.hpp>

#include <csignal>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

using Json = nlohmann::json;

class Program : public TemporaryFolder {
  protected:
    // Both of its streams go to the file "text". `own_group`: as a terminal's program is, its
    // process group has its number.
    pid_t start(std::vector<std::string> words, bool own_group = false) const {
        words.insert(words.begin(), PLAIT_SIMULATE);
        std::vector<char*> arguments;
        for (std::string& word : words)
            arguments.push_back(word.data());
        arguments.push_back(nullptr);
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, path("text").c_str(),
                                         O_WRONLY | O_CREAT | O_TRUNC, 0600);
        posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
        posix_spawnattr_t attributes;
        posix_spawnattr_init(&attributes);
        if (own_group)
            posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
        pid_t pid = -1;
        EXPECT_EQ(
            posix_spawn(&pid, PLAIT_SIMULATE, &actions, &attributes, arguments.data(), environ), 0);
        posix_spawnattr_destroy(&attributes);
        posix_spawn_file_actions_destroy(&actions);
        return pid;
    }

    static int wait_for(pid_t pid) {
        int status = -1;
        waitpid(pid, &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

    int run(const std::vector<std::string>& words) const { return wait_for(start(words)); }

    std::string text() const {
        std::ifstream stream(path("text"));
        return {std::istreambuf_iterator<char>(stream), {}};
    }

    Json json(const std::string& name) const {
        std::ifstream stream(path(name));
        return Json::parse(stream, nullptr, false);
    }
};
