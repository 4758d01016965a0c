//! One iteration of the density constraint as the paper writes it (Macklin & Müller 2013, eqs. 1, 2, 8–14), pair by pair
//! in double precision, with rock and walls as `smoothing` documents them. Slow, and nothing in it is shared with the
//! passes that it checks.

use crate::params::{Domain, FluidParams, GradientKernel, Quality};
use std::f64::consts::PI;

/// A point or a vector, d.
pub(crate) type Vector = [f64; 2];

/// What one iteration is asked for.
pub(crate) struct Question<'a> {
    pub(crate) particles: &'a [Vector],
    pub(crate) rock: &'a [Vector],
    pub(crate) domain: &'a Domain,
    pub(crate) fluid: &'a FluidParams,
    pub(crate) quality: &'a Quality,
    pub(crate) tension: bool,
    /// Whether the pressure predictor ran before.
    pub(crate) predicted: bool,
}

/// What one iteration gives: densities, λ and Δx before any limit.
pub(crate) struct Answer {
    pub(crate) density: Vec<f64>,
    pub(crate) lambda: Vec<f64>,
    pub(crate) moves: Vec<Vector>,
}

impl Question<'_> {
    /// The whole iteration.
    pub(crate) fn answer(&self) -> Answer {
        let rest = self.rest_density();
        let (mut density, mut lambda) = (Vec::new(), Vec::new());
        for &at in self.particles {
            let (wall_density, wall_push) = self.walls(at);
            let movable: f64 = self.particles.iter().map(|&other| self.weight(at, other)).sum();
            let fixed: f64 = self.rock.iter().map(|&other| self.weight(at, other)).sum();
            density.push((movable + fixed) / self.lattice() + wall_density);
            let constraint = (density[density.len() - 1] / rest - 1.0).max(f64::from(self.fluid.constraint_floor));
            // ∇_k C_i: for k = i the sum over all, for a movable neighbour k its own part; rock and walls are no k.
            let (mut own, mut squares) = ([wall_push[0] / rest, wall_push[1] / rest], 0.0);
            for &other in self.particles {
                let slope = self.slope(at, other).map(|part| part / rest);
                own = [own[0] + slope[0], own[1] + slope[1]];
                squares += slope[0] * slope[0] + slope[1] * slope[1];
            }
            for &other in self.rock {
                let slope = self.slope(at, other).map(|part| part / rest);
                own = [own[0] + slope[0], own[1] + slope[1]];
            }
            squares += own[0] * own[0] + own[1] * own[1];
            let relaxation = f64::from(self.fluid.relaxation);
            lambda.push(
                -constraint
                    / (squares
                        + if self.predicted {
                            relaxation.max(0.2 * f64::from(self.quality.substeps))
                        } else {
                            relaxation
                        }),
            );
        }
        let moves = (0..self.particles.len()).map(|i| self.correction(i, &lambda)).collect();
        Answer { density, lambda, moves }
    }

    /// Eq. 14. Rock and walls mirror the λ of the particle that they push.
    fn correction(&self, i: usize, lambda: &[f64]) -> Vector {
        let at = self.particles[i];
        let (_, wall_push) = self.walls(at);
        let mut sum = wall_push.map(|part| 2.0 * lambda[i] * part);
        let mut add = |pressure: f64, slope: Vector| {
            sum = [sum[0] + pressure * slope[0], sum[1] + pressure * slope[1]];
        };
        for (j, &other) in self.particles.iter().enumerate() {
            add(lambda[i] + lambda[j] + self.tensile(at, other), self.slope(at, other));
        }
        for &other in self.rock {
            add(2.0 * lambda[i], self.slope(at, other));
        }
        let constrained = sum.map(|part| part / self.rest_density());
        if !self.predicted {
            return constrained;
        }
        // Pairs nearer than 0.8 d are set apart by up to half their distance.
        self.particles.iter().fold(constrained, |sum, &other| {
            let share = 0.5 * (1.0 - distance2(at, other) / 0.64).max(0.0);
            [sum[0] + share * (at[0] - other[0]), sum[1] + share * (at[1] - other[1])]
        })
    }

    /// After the predictor the constraint aims 1 % lower.
    fn rest_density(&self) -> f64 {
        f64::from(self.fluid.rest_density)
    }

    fn h(&self) -> f64 {
        f64::from(self.quality.kernel_radius)
    }

    /// Poly6, bare.
    fn weight(&self, a: Vector, b: Vector) -> f64 {
        let h = self.h();
        (h * h - distance2(a, b)).max(0.0).powi(3)
    }

    /// The sum of the bare weights on the square lattice of spacing 1, which has density 1.
    fn lattice(&self) -> f64 {
        let sites = || (-5..=5).map(f64::from);
        sites().flat_map(|y| sites().map(move |x| [x, y])).map(|site| self.weight([0.0, 0.0], site)).sum()
    }

    /// ∇W at `a` for a neighbour at `b`.
    fn slope(&self, a: Vector, b: Vector) -> Vector {
        let (h, r2) = (self.h(), distance2(a, b));
        if r2 == 0.0 || r2 >= h * h {
            return [0.0, 0.0];
        }
        let per_distance = match self.quality.gradient {
            GradientKernel::Spiky => {
                let r = r2.sqrt();
                30.0 / (PI * h.powi(5)) * (h - r).powi(2) / r
            }
            GradientKernel::Rational => {
                30.0 / (PI * h.powi(5)) * (h * h - r2).powi(2) / (3.84 * h * (r2 + 0.165 / 3.84 * h * h))
            }
        };
        [-per_distance * (a[0] - b[0]), -per_distance * (a[1] - b[1])]
    }

    /// Eq. 13.
    fn tensile(&self, a: Vector, b: Vector) -> f64 {
        if !self.tension {
            return 0.0;
        }
        let at_distance = f64::from(self.fluid.tension_distance) * self.h();
        let reference = self.weight([0.0, 0.0], [at_distance, 0.0]);
        -f64::from(self.fluid.tension_strength) * (self.weight(a, b) / reference).powi(4)
    }

    /// Density of the half planes beyond the four walls and the sum of ∇W over them; where two walls meet, their
    /// overlap counts once.
    fn walls(&self, at: Vector) -> (f64, Vector) {
        let size = self.domain.size.as_dvec2();
        let axis = |at: f64, size: f64| {
            let (low, high) = (self.half_plane(at), self.half_plane(size - at));
            (low.0 + high.0, high.1 - low.1)
        };
        let (x, y) = (axis(at[0], size.x), axis(at[1], size.y));
        (x.0 + y.0 - x.0 * y.0, [x.1 * (1.0 - y.0), y.1 * (1.0 - x.0)])
    }

    /// Density of the half plane beyond a wall at `distance`, and the push of its ∇W towards the wall, both as integrals
    /// over lines parallel to it: of poly6, and (Gauss's theorem) of the kernel of the gradient along the wall itself.
    fn half_plane(&self, distance: f64) -> (f64, f64) {
        let h = self.h();
        if distance >= h {
            return (0.0, 0.0);
        }
        // ∫ (c − s²)³ ds = 32/35 c^3.5 over |s| < √c
        let line = |n: f64| 4.0 / (PI * h.powi(8)) * 32.0 / 35.0 * (h * h - n * n).max(0.0).powf(3.5);
        let density = simpson(distance, h, line);
        let half = (h * h - distance * distance).sqrt();
        let push = simpson(-half, half, |s| self.kernel_of_gradient((distance * distance + s * s).sqrt()));
        (density, push)
    }

    /// The kernel whose gradient is the one in use: W(r) = ∫ |∇W| from r to h.
    fn kernel_of_gradient(&self, r: f64) -> f64 {
        let h = self.h();
        match self.quality.gradient {
            GradientKernel::Spiky => 10.0 / (PI * h.powi(5)) * (h - r).max(0.0).powi(3),
            GradientKernel::Rational => {
                let core = 0.165 / 3.84 * h * h;
                let top = h * h + core;
                let integral = |s: f64| top * top * s.ln() - 2.0 * top * s + 0.5 * s * s;
                30.0 / (PI * h.powi(5)) / (3.84 * h) * 0.5 * (integral(top) - integral((r * r).min(h * h) + core))
            }
        }
    }
}

fn distance2(a: Vector, b: Vector) -> f64 {
    (a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2)
}

/// Simpson's rule over 200 intervals.
fn simpson(from: f64, to: f64, f: impl Fn(f64) -> f64) -> f64 {
    let n = 200;
    let step = (to - from) / f64::from(n);
    let inner: f64 = (1..n).map(|k| f(from + f64::from(k) * step) * if k % 2 == 1 { 4.0 } else { 2.0 }).sum();
    (f(from) + inner + f(to)) * step / 3.0
}
