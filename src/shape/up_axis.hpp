#pragma once

#include <plexway/shape/shape.hpp>

namespace plexway {

/// The axis that probably points up, y or z. What is flat as terrain is lies; else what stands has
/// feet: at its lower end it is spread more widely than at its upper one, and more so than along
/// the other axes. Where neither tells, z. Positions only. Cost: linear.
char probable_up(const AnyShape& shape);

}  // namespace plexway
