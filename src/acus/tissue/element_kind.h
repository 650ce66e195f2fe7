// The two tetrahedra.
#pragma once

namespace acus::tissue {

// linear: the paper's constant-strain tetrahedron, which locks as Poisson's ratio nears 1/2.
// nodal_pressure: the same deviatoric response per element; the volumetric one works on the dilation averaged
// at the nodes (Bonet and Burton 1998; Joldes, Wittek and Miller 2009), which removes the locking.
enum class ElementKind { linear, nodal_pressure };

}  // namespace acus::tissue
