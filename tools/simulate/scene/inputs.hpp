// What a scene says and what the files hold that it names: whether another run would be the same.
#pragma once

#include "common.hpp"

#include <string>
#include <vector>

namespace simulate {

// As JSON. Where results go, and what computes them, is no part of it.
std::string inputs_of(const Json& document, const Origin& origin);

// Of two of those, in words: "seconds is 4, was 8". Empty: they are the same.
std::vector<std::string> differences(const Json& was, const Json& is);

} // namespace simulate
