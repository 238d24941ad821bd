//! A browser driven over the `WebDriver` protocol (W3C): Chromium, headless, through chromedriver on the loopback address.

use serde_json::{Value, json};
use std::env;
use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use tempfile::TempDir;

/// How often a driver is started until one keeps its port.
const STARTS: usize = 5;

/// The first of `names` among the programs of this machine.
fn program(names: &[&str]) -> Option<PathBuf> {
    let path = env::var_os("PATH")?;
    env::split_paths(&path)
        .flat_map(|folder| names.iter().map(move |name| folder.join(name)))
        .find(|p| p.is_file())
}

/// A browser with one window.
pub struct Browser {
    driver: Child,
    port: u16,
    session: String,
    /// Gone with the browser.
    profile: TempDir,
}

/// A driver at work, and its port. It takes one number for both families of addresses, and ends where another driver took the second
/// meanwhile: then it is started again.
fn started(program: &Path) -> (Child, u16) {
    let mut seen = Vec::new();
    for _ in 0..STARTS {
        let mut driver = Command::new(program)
            .arg("--port=0")
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        for line in BufReader::new(driver.stdout.take().unwrap()).lines().map_while(Result::ok) {
            if let Some((_, port)) = line.split_once("started successfully on port ") {
                return (driver, port.trim_end_matches('.').parse().unwrap());
            }
            seen.push(line);
        }
        driver.wait().unwrap();
    }
    panic!("chromedriver names no port: {}", seen.join("; "));
}

impl Browser {
    /// A browser with a window of this size; none, and a line that says so, where Chromium or its driver is not installed.
    pub fn open([width, height]: [u32; 2]) -> Option<Self> {
        let chromium = program(&["chromium", "chromium-browser", "google-chrome"]);
        let (Some(chromium), Some(driver)) = (chromium, program(&["chromedriver"])) else {
            // Not by a macro, whose lines a test that passes keeps to itself.
            let expected = "skipped: Chromium or chromedriver is not installed, so no page was opened\n";
            std::io::stderr().write_all(expected.as_bytes()).unwrap();
            return None;
        };
        let profile = tempfile::tempdir().unwrap();
        let (driver, port) = started(&driver);
        let mut browser = Self { driver, port, session: String::new(), profile };
        let data = format!("--user-data-dir={}", browser.profile.path().display());
        let size = format!("--window-size={width},{height}");
        let args = [
            "--headless",
            "--no-sandbox",
            "--disable-quic",
            "--no-first-run",
            "--disable-sync",
            "--use-angle=swiftshader",
            "--disable-background-networking",
            "--disable-component-update",
            "--enable-unsafe-swiftshader",
            &data,
            &size,
        ];
        let wanted = json!({ "browserName": "chrome", "goog:loggingPrefs": { "browser": "ALL" },
            "goog:chromeOptions": { "binary": chromium, "args": args } });
        let made = browser.ask("POST", "/session", &json!({ "capabilities": { "alwaysMatch": wanted } }));
        made["sessionId"].as_str().unwrap_or_else(|| panic!("{made}")).clone_into(&mut browser.session);
        // Chromium makes no window narrower than 500 pixels.
        let exactly = json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": false });
        browser.devtools("Emulation.setDeviceMetricsOverride", &exactly);
        Some(browser)
    }

    /// Sends a command and gives the value of its answer.
    fn ask(&self, method: &str, path: &str, body: &Value) -> Value {
        let body = if method == "POST" { body.to_string() } else { String::new() };
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        let length = body.len();
        let head = format!(
            "{method} {path} HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\nContent-Length: {length}\r\n\r\n"
        );
        stream.write_all((head + &body).as_bytes()).unwrap();
        // The driver keeps the connection open, so that only its head says where the answer ends.
        let mut reader = BufReader::new(stream);
        let mut line = String::new();
        let mut length = 0;
        while reader.read_line(&mut line).unwrap() > 2 {
            let lower = line.to_ascii_lowercase();
            length = lower
                .strip_prefix("content-length:")
                .map_or(length, |message| message.trim().parse().unwrap());
            line.clear();
        }
        let mut answer = vec![0; length];
        reader.read_exact(&mut answer).unwrap();
        serde_json::from_slice::<Value>(&answer).unwrap()["value"].take()
    }

    fn of_session(&self, method: &str, path: &str, body: &Value) -> Value {
        self.ask(method, &format!("/session/{}{path}", self.session), body)
    }

    /// Opens `page` at `hash` and waits until it is ready.
    pub fn go(&self, page: &Path, hash: &str) {
        self.of_session("POST", "/url", &json!({ "url": format!("file://{}#{hash}", page.display()) }));
        self.wait("return document.documentElement.dataset.ready === 'yes'");
    }

    /// What `script` returns.
    pub fn run(&self, script: &str) -> Value {
        self.of_session("POST", "/execute/sync", &json!({ "script": script, "args": [] }))
    }

    /// Runs `script` until it returns true.
    pub fn wait(&self, script: &str) {
        for _ in 0..200 {
            if self.run(script) == Value::Bool(true) {
                return;
            }
            std::thread::sleep(std::time::Duration::from_millis(100));
        }
        panic!("never true: {script}");
    }

    /// Presses and releases a key, as `WebDriver` writes it, on what has the focus.
    pub fn press(&self, key: &str) {
        let keys = ["keyDown", "keyUp"].map(|kind| json!({ "type": kind, "value": key }));
        self.of_session(
            "POST",
            "/actions",
            &json!({ "actions": [{ "type": "key", "id": "keys", "actions": keys }] }),
        );
    }

    /// The driver's name of the first element that `css` selects.
    fn element(&self, css: &str) -> String {
        let found = self.of_session("POST", "/element", &json!({ "using": "css selector", "value": css }));
        let ids = found.as_object().unwrap_or_else(|| panic!("{css}: {found}"));
        ids.values().next().and_then(Value::as_str).unwrap_or_else(|| panic!("{css}: {found}")).to_owned()
    }

    /// Moves the pointer through `places` on the first element that `css` selects, each by its offset in pixels from the
    /// element's middle; with its button down from the first to the last if it `drags`.
    pub fn point(&self, css: &str, places: &[[i32; 2]], drags: bool) {
        let element = json!({ "element-6066-11e4-a52e-4f735466cecf": self.element(css) });
        let moved = places.iter().map(
            |[x, y]| json!({ "type": "pointerMove", "duration": 50, "x": x, "y": y, "origin": element }),
        );
        let mut actions: Vec<Value> = moved.collect();
        if drags {
            actions.insert(1, json!({ "type": "pointerDown", "button": 0 }));
            actions.push(json!({ "type": "pointerUp", "button": 0 }));
        }
        let pointer = json!({ "type": "pointer", "id": "mouse", "parameters": { "pointerType": "mouse" }, "actions": actions });
        self.of_session("POST", "/actions", &json!({ "actions": [pointer] }));
    }

    /// Turns the wheel down by so many pixels over the first element that `css` selects.
    pub fn scroll(&self, css: &str, down: i32) {
        let element = json!({ "element-6066-11e4-a52e-4f735466cecf": self.element(css) });
        let action = json!({ "type": "scroll", "duration": 50, "x": 0, "y": 0, "deltaX": 0, "deltaY": down, "origin": element });
        let wheel = json!({ "type": "wheel", "id": "wheel", "actions": [action] });
        self.of_session("POST", "/actions", &json!({ "actions": [wheel] }));
    }

    /// Chooses `file` where the page asks for one.
    pub fn choose(&self, css: &str, file: &Path) {
        let path = format!("/element/{}/value", self.element(css));
        self.of_session("POST", &path, &json!({ "text": file.display().to_string() }));
    }

    /// Shows pages on another medium, or to a reader with other wishes, as the `DevTools` protocol writes them.
    pub fn emulate(&self, media: &Value) {
        self.devtools("Emulation.setEmulatedMedia", media);
    }

    fn devtools(&self, command: &str, parameters: &Value) {
        let command = json!({ "cmd": command, "params": parameters });
        self.of_session("POST", "/goog/cdp/execute", &command);
    }

    /// What the page wrote to its console.
    pub fn console(&self) -> Value {
        self.of_session("POST", "/se/log", &json!({ "type": "browser" }))
    }

    /// A picture of the window in base64, kept under `name` where `REPLAN_SCREENSHOTS` names a folder.
    pub fn picture(&self, name: &str) -> String {
        let picture = self.of_session("GET", "/screenshot", &Value::Null);
        let picture = picture.as_str().unwrap_or_else(|| panic!("{picture}")).to_owned();
        if let Some(folder) = env::var_os("REPLAN_SCREENSHOTS") {
            fs::write(Path::new(&folder).join(format!("{name}.base64")), &picture).unwrap();
        }
        picture
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        if !self.session.is_empty() && !std::thread::panicking() {
            self.of_session("DELETE", "", &Value::Null);
        }
        let _ = self.driver.kill();
        let _ = self.driver.wait();
    }
}
