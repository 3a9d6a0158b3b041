#include "server/daemon/templates.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "common/names.h"

namespace posed {

Templates::Templates(std::filesystem::path folder) : folder_(std::move(folder)) {
  std::error_code error;
  for (std::filesystem::recursive_directory_iterator it(folder_, error), end; !error && it != end;
       it.increment(error)) {
    if (it->path().extension() != ".json") continue;
    names_.push_back(std::filesystem::relative(it->path(), folder_, error).replace_extension().generic_string());
  }
  std::sort(names_.begin(), names_.end());
}

Result<std::string> Templates::read(const std::string& name) const {
  if (!std::binary_search(names_.begin(), names_.end(), name)) {
    return Error{"unknown_scene", "no template is called " + name.substr(0, 64), "/template",
                 did_you_mean(name, names_)};
  }
  std::ifstream file(folder_ / (name + ".json"), std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(file)), {});
  if (!file)
    return Error{"unknown_scene", "the template " + name + " cannot be read", "/template",
                 "was posed installed whole?"};
  return text;
}

}  // namespace posed
