// Rules of importing, of grooms and meshes.
#pragma once

#include "base/result.hpp"

namespace plait::api {

plait_import_options default_options();

// `given` NULL: the defaults.
Status read_options(const plait_import_options* given, plait_import_options& options);

} // namespace plait::api
