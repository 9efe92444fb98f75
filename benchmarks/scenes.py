"""The scenes on which speed and accuracy are measured."""

from dataclasses import dataclass


@dataclass
class Scene:
    title: str
    dim: int = 2
    phi: float = 0.90
    K: float = 1.0e-3
    gas: str = "0.1"        # arguments of fix foam/coarsen after K
    rate: float = 0.0       # of shear
    drag: str = "static"
    until: tuple = (0.02, 0.1, 1.0)     # tau, or strain: positions are compared at the first

    @property
    def clock(self):
        return self.K or self.rate      # tau or strain in a unit of time

    def variables(self):
        return {"dim": self.dim, "K": self.K, "gas": self.gas, "rate": self.rate, "drag": self.drag,
                "until": tuple(f"{t / self.clock:.10g}" for t in self.until)}


SCENES = {
    "2d": Scene("2D, gas fraction 0.90"),
    "jam": Scene("2D, gas fraction 0.845", phi=0.845),
    "3d": Scene("3D, gas fraction 0.75", dim=3, phi=0.75),
    "slow": Scene("2D, gas fraction 0.90, K = 1e-4", K=1.0e-4),
    "bubbly": Scene("2D, bubbly liquid, gas fraction 0.3, kappa = 1", phi=0.3, gas="1.0"),
    "shear": Scene("2D, gas fraction 0.90, fixed sizes, sheared at the rate 1e-4", K=0.0,
                   rate=1.0e-4, until=(0.002, 0.01, 0.05)),
    "drag": Scene("2D, gas fraction 0.90, fixed sizes, sheared at the rate 1e-4, neighbor drag",
                  K=0.0, rate=1.0e-4, drag="neighbor", until=(0.002, 0.01, 0.05)),
}
QUICK = ["2d", "3d", "shear"]
