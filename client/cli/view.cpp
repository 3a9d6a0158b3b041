#include "client/cli/view/view.h"

#include "client/cli/output.h"

namespace posed::cli {

int run_view(const Session& session, const view::Options& options, bool once) {
  if (session.json)
    return fail({"bad_usage", "a view is for eyes, and has no JSON", "", "posectl --json watch pose has the numbers"});
  view::Options all = options;
  all.where = session.where;
  if (once) {
    const auto picture = view::once(session.client, all);
    if (!picture) return fail(picture.error());
    std::fputs(picture->c_str(), stdout);
    return kDone;
  }
  const Status viewed = view::run(session.client, all);
  return viewed ? kDone : fail(viewed.error());
}

}  // namespace posed::cli
