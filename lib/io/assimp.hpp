// What all readers by assimp keep it from.
#pragma once

#include <assimp/BaseImporter.h>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <assimp/importerdesc.h>

#include <algorithm>
#include <memory>
#include <span>
#include <string_view>

namespace plait {

// assimp shows a file that it does not take for its own to all of its readers, and some of the old
// ones run out of bounds on the way.
inline void keep_importers(Assimp::Importer& importer, std::span<const std::string_view> names) {
    for (size_t i = importer.GetImporterCount(); i-- > 0;) {
        const std::string_view name = importer.GetImporterInfo(i)->mName;
        if (std::ranges::find(names, name) != names.end())
            continue;
        const std::unique_ptr<Assimp::BaseImporter> other(importer.GetImporter(i));
        importer.UnregisterLoader(other.get()); // which leaves it to us
    }
}

// Materials (`mtllib`) are of no use here, and would be more bytes to doubt.
class NoOtherFiles : public Assimp::IOSystem {
  public:
    bool Exists(const char*) const override { return false; }
    char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char*, const char*) override { return nullptr; }
    void Close(Assimp::IOStream*) override {}
};

} // namespace plait
