#pragma once

namespace plexway {

/// So often what simplices that a round settled hear from their neighbours is passed on, before
/// their offers are made; each time all of them hear first and then change their labels.
inline constexpr int narrowing_sweeps = 3;

}  // namespace plexway
