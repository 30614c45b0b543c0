//! Exact solutions of gas dynamics: the blast of a point, and the breaking of a diaphragm.

/// The blast of a point in a gas at rest (Sedov 1946; Taylor 1950), in three dimensions and a uniform density, in the closed
/// form as Kamm and Timmes (2007) write it.
pub struct Blast {
    gamma: f64,
    /// Radius of the shock.
    pub radius: f64,
    density: f64,
    time: f64,
}

impl Blast {
    /// At time `time` after `energy` was set free in a gas of this density.
    pub fn new(gamma: f64, energy: f64, density: f64, time: f64) -> Blast {
        let alpha = alpha(gamma);
        let radius = (energy * time * time / (alpha * density)).powf(0.2);
        Blast { gamma, radius, density, time }
    }

    /// Speed of the gas right behind the shock.
    pub fn speed_behind(&self) -> f64 {
        2.0 / (self.gamma + 1.0) * 0.4 * self.radius / self.time
    }

    /// Density at a radius.
    pub fn density(&self, radius: f64) -> f64 {
        if radius >= self.radius {
            return self.density;
        }
        let wanted = radius / self.radius;
        let (mut low, mut high) = (2.0 / (5.0 * self.gamma), 4.0 / (5.0 * (self.gamma + 1.0)));
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if point(self.gamma, middle)[0] < wanted { low = middle } else { high = middle }
        }
        self.density * (self.gamma + 1.0) / (self.gamma - 1.0) * point(self.gamma, 0.5 * (low + high))[2]
    }
}

/// Radius, speed, density and pressure over those at the shock, by the parameter V of the closed form.
fn point(gamma: f64, v: f64) -> [f64; 4] {
    let j = 3.0;
    let a2 = (1.0 - gamma) / (2.0 * (gamma - 1.0) + j);
    let a1 = 5.0 * gamma / (2.0 + j * (gamma - 1.0)) * (2.0 * j * (2.0 - gamma) / (gamma * 25.0) - a2);
    let a3 = j / (2.0 * (gamma - 1.0) + j);
    let a4 = 5.0 * j / (j * (2.0 - gamma)) * a1;
    let a5 = -2.0 / (2.0 - gamma);
    let b = (gamma + 1.0) / (gamma - 1.0);
    let d = 5.0 * (gamma + 1.0) / (5.0 * (gamma + 1.0) - 2.0 * (2.0 + j * (gamma - 1.0)));
    let x1 = 1.25 * (gamma + 1.0) * v;
    let x2 = (b * (2.5 * gamma * v - 1.0)).max(0.0);
    let x3 = d * (1.0 - 0.5 * (2.0 + j * (gamma - 1.0)) * v);
    let x4 = b * (1.0 - 2.5 * v);
    let radius = x1.powf(-0.4) * x2.powf(-a2) * x3.powf(-a1);
    let pressure = x1.powf(0.4 * j) * x3.powf(a4 - 2.0 * a1) * x4.powf(1.0 + a5);
    [radius, x1 * radius, x2.powf(a3) * x3.powf(a4) * x4.powf(a5), pressure]
}

/// α in E = α ρ R⁵/t²: kinetic and internal energy over the self-similar profile.
pub fn alpha(gamma: f64) -> f64 {
    let (low, high) = (2.0 / (5.0 * gamma), 4.0 / (5.0 * (gamma + 1.0)));
    let steps = 200_000;
    let mut sum = 0.0;
    let mut last = point(gamma, low);
    for i in 1..=steps {
        // Points crowd together where the profile begins.
        let s = i as f64 / steps as f64;
        let here = point(gamma, low + (high - low) * s.powi(4));
        let middle: [f64; 4] = std::array::from_fn(|k| 0.5 * (last[k] + here[k]));
        let [r, u, g, p] = middle;
        // ρ₂ = ρ (γ+1)/(γ−1), u₂ = 2 Ṙ/(γ+1), p₂ = 2 ρ Ṙ²/(γ+1), Ṙ = 0.4 R/t.
        let kinetic = 0.5 * (gamma + 1.0) / (gamma - 1.0) * g * (2.0 / (gamma + 1.0) * u).powi(2);
        let internal = 2.0 / (gamma + 1.0) * p / (gamma - 1.0);
        sum += 4.0 * std::f64::consts::PI * r * r * (here[0] - last[0]) * (kinetic + internal) * 0.16;
        last = here;
    }
    sum
}

/// A gas on one side of a diaphragm: density, speed, pressure.
#[derive(Debug, Clone, Copy)]
pub struct Side {
    /// Mass density.
    pub density: f64,
    /// Speed.
    pub speed: f64,
    /// Pressure.
    pub pressure: f64,
}

/// What comes of a diaphragm that breaks between two states of a gas (Riemann's problem), with a fan to the left and a shock
/// to the right.
#[derive(Debug)]
pub struct Tube {
    gamma: f64,
    left: Side,
    right: Side,
    /// Pressure between the waves.
    pub pressure: f64,
    /// Speed between the waves.
    pub speed: f64,
    /// Density left and right of where the two gases touch.
    pub density: [f64; 2],
    /// Speeds of the fan's head and tail, of the boundary of the gases, and of the shock.
    pub waves: [f64; 4],
}

impl Tube {
    /// By bisection of the speeds that fan and shock give at a pressure.
    pub fn new(gamma: f64, left: Side, right: Side) -> Tube {
        let sound = |side: Side| (gamma * side.pressure / side.density).sqrt();
        let half = (gamma - 1.0) / (2.0 * gamma);
        let fan = |p: f64| left.speed + 2.0 * sound(left) / (gamma - 1.0) * (1.0 - (p / left.pressure).powf(half));
        let ratio = (gamma - 1.0) / (gamma + 1.0);
        let shock = |p: f64| {
            let stiff = 2.0 / ((gamma + 1.0) * right.density) / (p + ratio * right.pressure);
            right.speed + (p - right.pressure) * stiff.sqrt()
        };
        let (mut low, mut high) = (right.pressure, left.pressure);
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if shock(middle) < fan(middle) { low = middle } else { high = middle }
        }
        let pressure = 0.5 * (low + high);
        let speed = shock(pressure);
        let over = pressure / right.pressure;
        let density = [
            left.density * (pressure / left.pressure).powf(1.0 / gamma),
            right.density * (over + ratio) / (ratio * over + 1.0),
        ];
        let mass_flow = right.density * density[1] / (density[1] - right.density);
        let waves = [
            left.speed - sound(left),
            speed - (gamma * pressure / density[0]).sqrt(),
            speed,
            right.speed + mass_flow * (speed - right.speed) / right.density,
        ];
        Tube { gamma, left, right, pressure, speed, density, waves }
    }
}

impl Tube {
    /// Density where x/t has this value.
    pub fn density_at(&self, speed: f64) -> f64 {
        let Tube { gamma, left, right, density, waves, .. } = self;
        match speed {
            s if s < waves[0] => left.density,
            s if s < waves[1] => {
                let sound = (gamma * left.pressure / left.density).sqrt();
                let here = (2.0 * sound + (gamma - 1.0) * (left.speed - s)) / (gamma + 1.0);
                left.density * (here / sound).powf(2.0 / (gamma - 1.0))
            }
            s if s < waves[2] => density[0],
            s if s < waves[3] => density[1],
            _ => right.density,
        }
    }
}
