// Takes back what text_begin.inl defines.
#undef HINGE_FN
#undef HINGE_COLD
#undef HINGE_CONST
#undef HINGE_IN
#undef HINGE_METHOD
#undef HINGE_READS
#undef HINGE_EPSILON
#undef HINGE_TINY
#undef HINGE_INFINITY
#undef HINGE_PRECISE
