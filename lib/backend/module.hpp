// Shared modules by the operating system's own loader.
#pragma once

#include "base/result.hpp"

namespace plait {

// Never closed: what a module has loaded in turn may have left threads. @errors NOT_FOUND
Result<void*> open_module(const char* path);

// nullptr: the module has no such symbol.
void* find_symbol(void* module, const char* name);

} // namespace plait
