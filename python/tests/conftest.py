"""Before the library is loaded: threads that wait do not spin, so that processor time tells work."""

import os

os.environ.setdefault("OMP_WAIT_POLICY", "passive")
