// posectl: the daemon's tool for people and scripts.
#include "client/cli/options.h"
#include "client/cli/output.h"

int main(int argc, char** argv) {
  using namespace posed;
  auto parsed = cli::parse_options(argc, argv);
  if (const int* code = std::get_if<int>(&parsed)) return *code;
  const auto& options = std::get<cli::Options>(parsed);
  auto client = client::Client::connect(options.host);
  if (!client) return cli::fail(client.error());
  return options.run({*client, options.json});
}
