// What a kernel text means by its macros in C++, where it is the body of a class template with a
// type Real; text_end.inl takes them back. The shaders' meanings stand at the top of
// hinge_kernel.inl.
#if defined(__GNUC__)
#define HINGE_FN [[nodiscard, gnu::always_inline]] static inline
#else
#define HINGE_FN [[nodiscard]] static inline
#endif
#define HINGE_COLD [[nodiscard]] static inline
#define HINGE_CONST static constexpr
#define HINGE_IN(type) const type&
// A text that reads a scene, such as a solid, is the body of a class that has it.
#if defined(__GNUC__)
#define HINGE_METHOD [[nodiscard, gnu::always_inline]] inline
#else
#define HINGE_METHOD [[nodiscard]] inline
#endif
#define HINGE_READS const
// Relative rounding, and a square below which a length counts as zero: small enough for data in
// any unit, large enough that no quotient by it overflows.
#define HINGE_EPSILON Real(std::numeric_limits<Real>::epsilon())
#define HINGE_TINY (Real(std::numeric_limits<Real>::min()) / (HINGE_EPSILON * HINGE_EPSILON))
#define HINGE_INFINITY Real(std::numeric_limits<Real>::infinity())
// In a shader: not contracted to fused multiply-adds. C++ is compiled with -ffp-contract=off.
#define HINGE_PRECISE
