// Whose edits posectl's are: the same editor each time it runs, so that `posectl undo` finds what it did before.
#pragma once

#include <string>

namespace posed::cli {

// A key that only this user of this machine can read, made once; empty where nothing can be kept.
// It is at $XDG_STATE_HOME/posectl/editor, else ~/.local/state/posectl/editor.
std::string editor_key();
// Of the user that runs us.
std::string user_name();

}  // namespace posed::cli
