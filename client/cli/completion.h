// What a shell reads to complete posectl's words.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace posed::cli {

// `shell` is bash or zsh.
std::string completion_script(const CLI::App& app, const std::string& shell);

}  // namespace posed::cli
