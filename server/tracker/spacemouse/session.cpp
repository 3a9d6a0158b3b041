#include "server/tracker/spacemouse/session.h"

#include "server/tracker/conversation.h"

namespace posed::tracker {

bool SpacemouseSession::set_up(Conversation& with) {
  with.begin(1);
  return true;
}

}  // namespace posed::tracker
